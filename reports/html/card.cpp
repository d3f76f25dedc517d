#include <fmt/format.h>

#include "text.h"
#include "view.h"

namespace evalcts::reports::view {
namespace {

std::string integer(std::optional<std::int64_t> n) { return n ? fmt::format("{}", *n) : std::string(); }

std::string headline_of(const RunResult& record) {
  const std::uint64_t unexpected = record.unexpected_count(), expected = record.expected_failure_count();
  if (!record.has_started()) return "not started";
  std::string headline = unexpected ? count(unexpected, "unexpected result") : "nothing unexpected";
  if (expected) headline += ", " + count(expected, "failing test") + " as the baseline expects";
  if (!record.status) headline = "status unknown: " + headline;
  if (record.status == RunStatus::kInterrupted) headline = "interrupted: " + headline;
  return headline;
}

}  // namespace

data card(const Column& column) {
  const RunResult& record = column.record;
  const ImplementationRecord& implementation = record.implementation;
  const bool bad = record.unexpected_count() || !record.is_complete();

  data out;
  out.set("label", column.label);
  out.set("state", !record.has_started() ? "none" : bad ? "bad" : "good");
  out.set("headline", headline_of(record));
  out.set("reason", optional_text(record.reason));

  data counts = list();
  for (std::size_t i = 0; i < kVerdicts; ++i) {
    if (!record.counts[i]) continue;
    data item;
    set_verdict(item, static_cast<Verdict>(i));
    item.set("n", fmt::format("{}", record.counts[i]));
    counts << item;
  }
  out.set("counts", counts);

  data facts = list();
  add_row(facts, "Library", implementation.library);
  add_row(facts, "Vendor", implementation.vendor);
  add_row(facts, "Renderer", implementation.renderer);
  add_row(facts, "Version", implementation.version);
  add_row(facts, "Note", implementation.note);
  out.set("facts", facts);

  data circumstances = list();
  add_row(circumstances, "From", record.origin);
  add_row(circumstances, "Tests", fmt::format("{}", record.total()));
  add_row(circumstances, "Shard", record.shard ? record.shard->text() : "");
  add_row(circumstances, "Depth", record.depth ? name_of(*record.depth) : "");
  add_row(circumstances, "Seed", record.seed ? fmt::format("{}", *record.seed) : "");
  add_row(circumstances, "Baseline", record.baseline);
  add_row(circumstances, "Stale in the baseline", join(record.stale_baseline_entries, ", "));
  add_row(circumstances, "Largest order", integer(implementation.max_eval_order));
  add_row(circumstances, "Loaded", join(implementation.files, ", "));
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
