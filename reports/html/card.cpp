// The parts of the page about single runs: their cards, and the readings of ambiguous passages.
#include <fmt/format.h>

#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

std::string integer(std::optional<std::int64_t> n) { return n ? fmt::format("{}", *n) : std::string(); }

}  // namespace

data card(const Column& column, const std::vector<std::string>& files) {
  const RunResult& record = column.record;
  const ImplementationRecord& implementation = record.implementation;

  data out;
  out.set("label", column.label);
  data facts = list();
  add_row(facts, "Library", implementation.library);
  add_row(facts, "Contexts of", implementation.context_library);
  add_row(facts, "Vendor", implementation.vendor);
  add_row(facts, "Renderer", implementation.renderer);
  add_row(facts, "Version", implementation.version);
  add_row(facts, "Loaded", join(implementation.files, ", "));
  add_row(facts, "Note", implementation.note);
  add_row(facts, "Run", time_of(record));
  add_row(facts, "Host", record.host);
  out.set("facts", facts);
  data links = list();
  for (const std::string& file : files) {
    data one;
    one.set("name", file.substr(file.rfind('/') + 1));
    one.set("address", link_to_file(file));
    links << one;
  }
  out.set("has_files", !files.empty());
  out.set("files", links);

  data circumstances = list();
  add_row(circumstances, "From", record.origin);
  add_row(circumstances, "Tests", fmt::format("{}", record.total()));
  add_row(circumstances, "Shard", record.shard ? record.shard->text() : "");
  add_row(circumstances, "Depth", record.depth ? name_of(*record.depth) : "");
  add_row(circumstances, "Seed", record.seed ? fmt::format("{}", *record.seed) : "");
  add_row(circumstances, "Baseline", record.baseline);
  add_row(circumstances, "Stale in the baseline", join(record.stale_baseline_entries, ", "));
  add_row(circumstances, "Largest order", integer(implementation.max_eval_order));
  add_row(circumstances, "Machine", implementation.machine);
  add_row(circumstances, "Command", record.command, true);
  add_row(circumstances, "evalcts", record.evalcts_version);
  out.set("circumstances", circumstances);

  data captures = list();
  std::size_t available = 0;
  for (const CaptureRecord& capture : implementation.captures) {
    available += capture.available;
    data item;
    item.set("capture", capture.name);
    item.set("availability", capture.available ? "available" : "not available");
    item.set("why", optional_text(capture.reason));
    captures << item;
  }
  out.set("has_captures", !implementation.captures.empty());
  out.set("captures_summary", fmt::format("{} of {} available", available, implementation.captures.size()));
  out.set("captures", captures);
  return out;
}

data readings(const std::vector<Column>& columns, const Catalogue& catalogue) {
  std::map<std::string, std::vector<std::vector<std::string>>> followed;  // by text, then by column
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const auto& [text, names] : columns[i].record.readings) {
      auto& of_text = followed[text];
      of_text.resize(columns.size());
      of_text[i] = names;
    }
  data out = list();
  for (const auto& [text, by_column] : followed) {
    const Ambiguity* const found = catalogue.find_ambiguity(text);
    const Ambiguity known = found ? *found : Ambiguity{};
    data row, cells = list();
    row.set("id", text);
    row.set("text", optional_text(known.text()));
    row.set("where", optional_text(known.where));
    for (const std::vector<std::string>& names : by_column) {
      data cell, lines = list();
      for (const std::string& name : names) {
        const auto meaning = known.readings.find(name);
        data line;
        line.set("reading", name);
        line.set("meaning", optional_text(meaning == known.readings.end() ? "" : meaning->second));
        lines << line;
      }
      cell.set("lines", lines);
      cells << cell;
    }
    row.set("cells", cells);
    out << row;
  }
  return out;
}

}  // namespace evalcts::reports::view
