// `evalcts convert`: makes recordings of traces, and vectors, C programs and meshes of recordings.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>

#include <evalcts/cli/recordings.h>
#include <evalcts/cli/specified_run.h>
#include <evalcts/gl/c_program.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/record/programs.h>
#include <evalcts/results/files.h>
#include <evalcts/results/text.h>
#include <evalcts/vectors/write.h>
#include "apitrace.h"
#include "lab.h"
#include "wavefront.h"

namespace evalcts::cli {
namespace {

namespace fs = std::filesystem;
using record::Program;
using record::Recording;

struct ConvertOptions {
  std::string file;
  std::string output;
  std::string frames;  // "A..B"; empty: all
};

// Thrown if there is nothing to write. what() states the reason.
struct CannotConvert : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Writes the file and prints its name and content.
void write(const fs::path& file, const std::string& text, const std::string& content) {
  write_atomically(file, text);
  std::cout << fmt::format("wrote {}: {}\n", file.string(), content);
}

std::string object_name(std::string program) {
  std::ranges::replace(program, '/', '-');
  return program;
}

void write_meshes(const fs::path& file, const std::vector<Program>& programs) {
  std::vector<lab::Object> objects;
  std::size_t vertices = 0;
  for (const Program& program : programs) {
    Prediction prediction = predict(gl::parse_case(program.commands), reference::kMaxOrder);
    vertices += prediction.vertex_count();
    objects.push_back({object_name(program.name), std::move(prediction.primitives)});
  }
  write(file, lab::wavefront(objects), fmt::format("objects: {}, vertices: {}", objects.size(), vertices));
}

void write_vectors_of(const fs::path& file, const std::vector<Program>& programs) {
  std::vector<vectors::SuiteCase> cases;
  for (const Program& program : programs)
    cases.push_back({"Recording." + program.name, {"EV-COORD-ASIF"}, gl::parse_case(program.commands)});
  const vectors::Sequences sequences = vectors::sequences_of_programs(cases);
  if (sequences.cases == 0) throw CannotConvert("no program of these frames has a form in the vectors");
  write(file, sequences.text,
        fmt::format("cases: {} of {}; shortened: {}", sequences.cases, programs.size(), sequences.shortened));
}

// A program of a recording ends by asking for errors.
gl::Case without_last_get_errors(const gl::Case& script) {
  std::size_t count = script.commands().size();
  while (count > 0 && script.commands()[count - 1].entry == gl::EntryPoint::GetError) --count;
  gl::Case shorter;
  for (std::size_t i = 0; i < count; ++i) shorter.add(script.commands()[i]);
  return shorter;
}

// If there are several programs, each has a file of its own.
void write_c_programs(const fs::path& file, const std::vector<Program>& programs) {
  for (const Program& program : programs) {
    fs::path name = file;
    if (programs.size() > 1)
      name.replace_filename(fmt::format("{}-{}.c", file.stem().string(), object_name(program.name)));
    const gl::Case script = without_last_get_errors(gl::parse_case(program.commands));
    const gl::Check no_error = {.answer = {.kind = gl::Answer::Kind::kLeftOver, .is_error = true},
                                .accepted = {{GL_NO_ERROR, GL_NO_ERROR}},
                                .what = "the error that is left"};
    write(name,
          gl::to_c({.style = gl::CStyle::kShort,
                    .context = "egl",
                    .library = "libEGL.so.1",
                    .script = &script,
                    .check = may_raise_an_error(script, reference::kMaxOrder) ? nullptr : &no_error}),
          fmt::format("{}, vertices: {}", program.name, program.vertices));
  }
}

using WriteFunction = void (*)(const fs::path&, const std::vector<Program>&);
const std::map<std::string, WriteFunction> kFormats = {
    {".obj", write_meshes}, {".json", write_vectors_of}, {".c", write_c_programs}};

int convert(const ConvertOptions& options) {
  const fs::path file = options.file, output = fs::absolute(options.output).lexically_normal();
  const bool is_trace = lab::is_trace(file), to_recording = output.extension() == ".evalrec";
  const auto format = kFormats.find(output.extension().string());
  if (format == kFormats.end() && !to_recording)
    return wrong_use(fmt::format("--output '{}': the name must end in .evalrec, .json, .c or .obj",
                                 clean(options.output)));
  if (to_recording && !is_trace)
    return wrong_use(fmt::format("'{}' is not a trace of apitrace; only traces are converted to .evalrec",
                                 clean(options.file)));
  if (to_recording && !options.frames.empty())
    return wrong_use(
        "--frames chooses programs, and a recording of a trace has all frames; give it to check");
  const Scratch scratch;
  fs::path recorded = file;
  try {
    if (is_trace) {
      const lab::ImportedTrace imported = lab::import_trace(file);
      recorded = scratch.path() / "trace.evalrec";
      write_atomically(recorded, imported.recording.text());
      if (!imported.problem.empty()) std::cerr << fmt::format("note: {}\n", imported.problem);
    }
    const Recording recording(recorded);
    if (std::ranges::none_of(recording.commands(), is_of_evaluators))
      return wrong_use(fmt::format("'{}' has no evaluator commands", clean(options.file)));
    if (to_recording) {
      write_atomically(output, read_file(recorded));
      std::cout << "wrote " << summary_of(output, recording);
      return kNothingUnexpected;
    }
    if (!recording.problem().empty()) std::cerr << fmt::format("note: {}\n", recording.problem());
    const std::vector<Program> programs =
        record::programs_of(recording, record::parse_frames(options.frames).value_or(record::Frames()));
    if (programs.empty()) return wrong_use("in these frames no evaluator command is executed");
    format->second(output, programs);
  } catch (const lab::BadTrace& error) {
    return wrong_use(fmt::format("'{}' {}", clean(options.file), error.what()));
  } catch (const record::BadRecording& error) {
    return wrong_use(
        fmt::format("{}; convert reads recordings of 'evalcts record' and traces of apitrace", error.what()));
  } catch (const CannotConvert& error) {
    return wrong_use(error.what());
  } catch (const CannotWrite& error) {
    return wrong_use(error.what());
  }
  return kNothingUnexpected;
}

std::function<int()> define_convert(CLI::App& app, const Call&) {
  const auto options = std::make_shared<ConvertOptions>();
  app.add_option("file", options->file, "a recording of 'evalcts record', or a trace of apitrace")
      ->required();
  app.add_option(
         "-o,--output", options->output,
         "file to write: NAME.evalrec, a recording; NAME.json, golden vectors; NAME.c, a C program for "
         "each program of the recording; NAME.obj, the exact meshes")
      ->required();
  app.add_option("--frames", options->frames, "convert these frames only, as A..B or A, from 0")
      ->check(check_frames);
  return [options] { return convert(*options); };
}

}  // namespace

const Command kConvertCommand = {kConvert.name, kConvert.description,
                                 R"(  $ evalcts convert game.trace -o game.evalrec
  $ evalcts convert game.evalrec --frames 12 -o teapot.obj
  $ evalcts convert game.evalrec -o game.json)",
                                 define_convert};

}  // namespace evalcts::cli
