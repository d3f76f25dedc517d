// Describes the environment variables and EGL vendor files that select GL drivers, with values that cannot be
// right, and compares the requested driver with the loaded one.
#include <evalcts/backends/gl_environment.h>
#include <evalcts/results/files.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/json.h>
#include "shared_library.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;

enum class Holds { kName, kFiles, kDirectories, kDriverDirectories };

struct Variable {
  const char* name;
  Holds holds;
};

constexpr std::array kVariables = {
    Variable{"GALLIUM_DRIVER", Holds::kName},
    Variable{"MESA_LOADER_DRIVER_OVERRIDE", Holds::kName},
    Variable{"LIBGL_ALWAYS_SOFTWARE", Holds::kName},
    Variable{"EGL_PLATFORM", Holds::kName},
    Variable{"__GLX_VENDOR_LIBRARY_NAME", Holds::kName},
    Variable{"LIBGL_DRIVERS_PATH", Holds::kDriverDirectories},
    Variable{"LD_LIBRARY_PATH", Holds::kDirectories},
    Variable{"__EGL_VENDOR_LIBRARY_DIRS", Holds::kDirectories},
    Variable{"__EGL_VENDOR_LIBRARY_FILENAMES", Holds::kFiles},
    Variable{"VK_DRIVER_FILES", Holds::kFiles},
    Variable{"VK_ICD_FILENAMES", Holds::kFiles},
};

bool has_driver(const fs::path& directory) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(directory, unreadable))
    if (entry.path().filename().string().ends_with("_dri.so")) return true;
  return false;
}

// Returns the problem with one entry of a path list; empty if there is none.
std::string problem_of(const std::string& entry, Holds holds) {
  std::error_code error;
  if (holds == Holds::kName) return {};
  if (holds == Holds::kFiles)
    return fs::is_regular_file(entry, error) ? "" : fmt::format("no such file '{}'", entry);
  if (!fs::is_directory(entry, error)) return fmt::format("no such directory '{}'", entry);
  if (holds == Holds::kDriverDirectories && !has_driver(entry))
    return fmt::format("no *_dri.so in '{}'", entry);
  return {};
}

std::string value_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value ? value : "";
}

// Beginnings of the names of libraries of GLs, on Linux and on Windows.
constexpr const char* kFilesOfGl[] = {"libEGL",    "libGL",    "libOSMesa", "libgallium", "libvulkan",
                                      "libnvidia", "opengl32", "osmesa",    "nvoglv",     "atio"};

// Drivers whose name is part of GL_RENDERER; the first kSoftware of them run on the processor.
constexpr std::array<std::string_view, 7> kNamed = {"llvmpipe", "softpipe", "swr",   "zink",
                                                    "d3d12",    "virgl",    "svga3d"};
constexpr std::size_t kSoftware = 3;

bool is_named(std::string_view driver) { return std::ranges::find(kNamed, driver) != kNamed.end(); }

// Returns the driver that a renderer string names. The first name counts: "zink Vulkan 1.3(llvmpipe
// (LLVM 15.0.6, 256 bits))" is zink.
std::string_view driver_in(const std::string& renderer) {
  std::string lower = renderer;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  std::string_view first;
  std::size_t place = std::string::npos;
  for (const std::string_view name : kNamed)
    if (const std::size_t found = lower.find(name); found < place) {
      place = found;
      first = name;
    }
  return first;
}

}  // namespace

std::string describe_gl_environment() {
  std::vector<std::string> set;
  for (const Variable& variable : kVariables) {
    const std::string value = value_of(variable.name);
    if (value.empty()) continue;
    std::vector<std::string> problems;
    std::istringstream entries(value);
    for (std::string entry; std::getline(entries, entry, ':');)
      if (const std::string problem = problem_of(entry, variable.holds); !entry.empty() && !problem.empty())
        problems.push_back(problem);
    set.push_back(fmt::format("{}='{}'{}", variable.name, value,
                              problems.empty() ? "" : fmt::format(" ({})", fmt::join(problems, ", "))));
  }
  if (set.empty()) return {};
  return fmt::format("; the environment sets {}: {}", fmt::join(set, ", "),
                     set.size() == 1 ? "check this value, or unset the variable"
                                     : "check these values, or unset the variables");
}

std::string describe_egl_vendors() {
  const auto value_or = [](const char* variable, const char* otherwise) {
    const std::string value = value_of(variable);
    return value.empty() ? otherwise : value;
  };
  std::vector<fs::path> files;
  if (const std::string names = value_of("__EGL_VENDOR_LIBRARY_FILENAMES"); !names.empty()) {
    std::istringstream entries(names);
    for (std::string entry; std::getline(entries, entry, ':');) files.emplace_back(entry);
  } else {
    std::istringstream entries(
        value_or("__EGL_VENDOR_LIBRARY_DIRS", "/etc/glvnd/egl_vendor.d:/usr/share/glvnd/egl_vendor.d"));
    for (std::string entry; std::getline(entries, entry, ':');) {
      std::error_code unreadable;
      for (const auto& file : fs::directory_iterator(entry, unreadable))
        if (file.path().extension() == ".json") files.push_back(file.path());
    }
  }
  std::string problems;
  for (const fs::path& file : files) {
    if (!std::ifstream(file).is_open()) continue;  // describe_gl_environment() names it
    const nlohmann::json vendor = parse_json(read_file(file));
    const nlohmann::json::json_pointer place("/ICD/library_path");
    if (!vendor.is_object() || !vendor.contains(place)) {
      problems += fmt::format("; '{}' has no ICD.library_path", file.string());
      continue;
    }
    try {
      const SharedLibrary library{std::string(as_text(vendor[place]))};
    } catch (const CannotStart& error) {
      problems += fmt::format("; the EGL of '{}' is not used: {}", file.string(), error.what());
    }
  }
  return problems;
}

std::vector<std::string> loaded_gl_files() {
  std::vector<std::string> files = loaded_libraries();
  std::erase_if(files, [](const std::string& file) {
    const std::string name = fs::path(file).filename().string();
    return name.find("_dri.so") == std::string::npos &&
           std::ranges::none_of(kFilesOfGl,
                                [&](const char* beginning) { return name.starts_with(beginning); });
  });
  return files;
}

std::string describe_other_driver(const std::string& renderer) {
  for (const char* const variable : {"MESA_LOADER_DRIVER_OVERRIDE", "GALLIUM_DRIVER"}) {
    const std::string wanted = value_of(variable);
    const std::string_view found = driver_in(renderer);
    if (wanted.empty() || wanted == found) continue;
    const bool is_software =
        std::ranges::find(kNamed.begin(), kNamed.begin() + kSoftware, found) != kNamed.begin() + kSoftware;
    if (!is_named(wanted) && (!is_software || wanted.ends_with("swrast"))) continue;
    return fmt::format(
        "{}={} asks for another driver than the one that was judged: GL_RENDERER is '{}'. This GL does not "
        "have "
        "the driver, or does not read the variable.",
        variable, wanted, renderer);
  }
  return {};
}

}  // namespace evalcts
