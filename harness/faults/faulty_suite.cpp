// The suite program with faults. --variation NAME, --fault NAME and --base NAME put changes in front of the
// implementation under test, the variation outermost; --base names the repair or version that the faults of
// some implementations of layer.h need. --list-faults FILE and --list-variations FILE write all faults or
// variations as JSON.
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include <evalcts/faults/trial.h>
#include <evalcts/suite/suite_main.h>
#include "layer.h"

namespace {

using namespace evalcts;

// True if OSMesa can be opened. Mesa 25.1 and newer do not contain it, so the faults for OSMesa are injected
// into Mesa through EGL.
bool has_osmesa() {
  static const bool kHas = [] {
    try {
      open_implementation({"osmesa"})->create_context();
      return true;
    } catch (const CannotStart&) {
      return false;
    }
  }();
  return kHas;
}

// Returns the arguments that make this program open the implementation of a change.
std::vector<std::string> arguments_of(std::string_view implementation) {
  if (implementation == "osmesa" && !has_osmesa()) return {"--implementation", "egl"};
  if (implementation == "dropin" && !has_osmesa()) return {"--implementation", "dropin-egl"};
  if (implementation == faults::kNvVertexProgram) return {"--context", NV_VERTEX_PROGRAM_PROVIDER};
  if (implementation == faults::kColorIndex) return {"--context", COLOR_INDEX_PROVIDER};
  if (implementation == faults::kRepairedOSMesa || implementation == faults::kOSMesa30)
    return {"--implementation", has_osmesa() ? "osmesa" : "egl", "--base", std::string(implementation)};
  return {"--implementation", std::string(implementation)};
}

void list_changes(const char* file, bool variations) {
  std::vector<faults::ListedChange> all;
  for (const faults::Change& change : faults::all_changes()) {
    if (change.kind == faults::kRepair || (change.kind == faults::kVariation) != variations) continue;
    std::istringstream requirements{std::string(change.requirements)};
    all.push_back({std::string(change.name),
                   std::string(change.implementation),
                   arguments_of(change.implementation),
                   change.level,
                   {std::istream_iterator<std::string>(requirements), {}},
                   std::string(change.what),
                   std::string(change.kind)});
  }
  std::ofstream(file) << faults::to_text(all);
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> layers = {{"--variation", ""}, {"--fault", ""}, {"--base", ""}};
  std::vector<char*> rest;  // arguments of the ordinary suite program
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool has_value = i + 1 < argc;
    if (has_value && (argument == "--list-faults" || argument == "--list-variations")) {
      list_changes(argv[i + 1], argument == "--list-variations");
      return 0;
    }
    if (has_value && layers.contains(argument))
      layers[argument] = argv[++i];
    else
      rest.push_back(argv[i]);
  }
  rest.push_back(nullptr);
  std::vector<std::string> changes;
  if (layers["--base"] == faults::kOSMesa30) setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
  for (const char* const layer : {"--variation", "--fault", "--base"})
    if (const std::string& name = layers[layer]; !name.empty() && name != faults::kOSMesa30)
      changes.push_back(name);
  return suite_main(static_cast<int>(rest.size()) - 1, rest.data(),
                    [&](std::unique_ptr<Implementation> implementation) {
                      return faults::with_changes(std::move(implementation), changes);
                    });
}
