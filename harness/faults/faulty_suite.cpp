// The suite program with faults. --fault NAME injects a fault into the implementation under test, --base NAME
// first replaces this implementation by one of fault.h, and --variation NAME puts a variation in front of
// both. --list-faults FILE and --list-variations FILE write all faults or variations as JSON.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <evalcts/faults/fault_table.h>
#include <evalcts/suite/suite_main.h>
#include "fault.h"
#include "repaired_osmesa.h"
#include "variation.h"

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

// Returns the arguments that make this program open the implementation of a fault.
std::vector<std::string> arguments_of(std::string_view implementation) {
  if (implementation == "osmesa" && !has_osmesa()) return {"--implementation", "egl"};
  if (implementation == "dropin" && !has_osmesa()) return {"--implementation", "dropin-egl"};
  if (implementation == faults::kNvVertexProgram) return {"--context", NV_VERTEX_PROGRAM_PROVIDER};
  if (implementation == faults::kColorIndex) return {"--context", COLOR_INDEX_PROVIDER};
  if (implementation == faults::kRepairedOSMesa || implementation == faults::kOSMesa30)
    return {"--implementation", has_osmesa() ? "osmesa" : "egl", "--base", std::string(implementation)};
  return {"--implementation", std::string(implementation)};
}

void list_faults(const char* file) {
  std::vector<faults::ListedFault> all;
  for (const faults::Fault& fault : faults::all_faults()) {
    std::istringstream requirements{std::string(fault.requirements)};
    all.push_back({std::string(fault.name),
                   std::string(fault.implementation),
                   arguments_of(fault.implementation),
                   fault.level,
                   {std::istream_iterator<std::string>(requirements), {}},
                   std::string(fault.what),
                   fault.inject ? "wrapper" : "switch"});
  }
  std::ofstream(file) << faults::to_text(all);
}

void list_variations(const char* file) {
  std::vector<faults::ListedFault> all;
  for (const variations::Variation& variation : variations::all_variations()) {
    std::istringstream violated{std::string(variation.violates)};
    all.push_back({std::string(variation.name),
                   std::string(variation.implementation),
                   arguments_of(variation.implementation),
                   Level::kMust,
                   {std::istream_iterator<std::string>(violated), {}},
                   std::string(variation.what),
                   "variation"});
  }
  std::ofstream(file) << faults::to_text(all);
}

// Names of the layers in front of the implementation that the other arguments select, innermost first. A name
// may be empty.
struct Layers {
  std::string base, fault, variation;
};

std::unique_ptr<Implementation> wrapped(std::unique_ptr<Implementation> implementation,
                                        const Layers& layers) {
  if (layers.base == faults::kRepairedOSMesa)
    implementation = faults::repaired_osmesa(std::move(implementation));
  if (!layers.fault.empty()) implementation = faults::with_fault(std::move(implementation), layers.fault);
  if (!layers.variation.empty())
    implementation = variations::with_variation(std::move(implementation), layers.variation);
  return implementation;
}

}  // namespace

int main(int argc, char** argv) {
  Layers layers;
  std::vector<char*> rest;  // arguments of the ordinary suite program
  for (int i = 0; i < argc; ++i) {
    const bool has_value = i + 1 < argc;
    if (has_value && std::strcmp(argv[i], "--list-faults") == 0) {
      list_faults(argv[i + 1]);
      return 0;
    }
    if (has_value && std::strcmp(argv[i], "--list-variations") == 0) {
      list_variations(argv[i + 1]);
      return 0;
    }
    if (has_value && std::strcmp(argv[i], "--fault") == 0)
      layers.fault = argv[++i];
    else if (has_value && std::strcmp(argv[i], "--base") == 0)
      layers.base = argv[++i];
    else if (has_value && std::strcmp(argv[i], "--variation") == 0)
      layers.variation = argv[++i];
    else
      rest.push_back(argv[i]);
  }
  rest.push_back(nullptr);
  if (layers.base == faults::kOSMesa30) setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
  return suite_main(static_cast<int>(rest.size()) - 1, rest.data(),
                    [&](std::unique_ptr<Implementation> implementation) {
                      return wrapped(std::move(implementation), layers);
                    });
}
