// Finds the libraries of a Mesa in a folder, and sets the variables by which libglvnd, the loader of Mesa and
// the dynamic linker find them.
#include <evalcts/backends/mesa_build.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include <evalcts/backends/implementation.h>
#include <evalcts/results/hash.h>

namespace evalcts {
namespace {

namespace fs = std::filesystem;

// Libraries of Mesa, by the beginnings of their names. libEGL.so, libGL.so and libGLX.so may be libglvnd's.
constexpr const char* kOfMesa[] = {"libEGL_mesa.so", "libGLX_mesa.so", "libOSMesa.so", "libglapi.so",
                                   "libgallium"};
constexpr const char* kOfEither[] = {"libEGL.so", "libGL.so"};

constexpr char kUsed[] = "EVALCTS_MESA_BUILD";  // variable with the folder whose environment is set

bool begins_with_one_of(const std::string& name, const auto& beginnings) {
  return std::ranges::any_of(beginnings, [&](const char* beginning) { return name.starts_with(beginning); });
}

bool is_driver(const std::string& name) { return name.ends_with("_dri.so"); }

// The files of a folder and its subfolders that are libraries or drivers of Mesa, by name.
std::map<std::string, fs::path> libraries_in(const fs::path& folder) {
  std::map<std::string, fs::path> found;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error),
       end;
       !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_library =
        name.find(".so") != std::string::npos &&
        (begins_with_one_of(name, kOfMesa) || begins_with_one_of(name, kOfEither) || is_driver(name));
    if (is_library && fs::exists(entry->path())) found.emplace(name, fs::absolute(entry->path()));
  }
  return found;
}

// Returns a folder of this user for the files that a build folder lacks.
fs::path own_folder(const fs::path& build) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("evalcts-mesa-{}-{:08x}", getuid(),
                                                                  fnv1a<std::uint32_t>(build.string()));
  mkdir(folder.c_str(), S_IRWXU);
  struct stat status = {};
  if (lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != getuid())
    throw CannotStart(fmt::format(
        "--mesa-build: '{}' cannot be used, because it is not a folder of this user", folder.string()));
  return folder;
}

void put_before(const char* variable, const std::string& value) {
  const char* const old = std::getenv(variable);
  setenv(variable, (value + (old && *old ? ":" + std::string(old) : "")).c_str(), 1);
}

}  // namespace

void use_mesa_build(const fs::path& folder) {
  const std::map<std::string, fs::path> found = libraries_in(folder);
  const auto first = [&](const std::string& beginning) {
    const auto it =
        std::ranges::find_if(found, [&](const auto& each) { return each.first.starts_with(beginning); });
    return it == found.end() ? fs::path() : it->second;
  };
  const fs::path vendor = first("libEGL_mesa.so.0");
  if (vendor.empty() && first("libEGL.so.1").empty() && first("libGL.so.1").empty() &&
      first("libOSMesa.so").empty())
    throw CannotStart(
        fmt::format("--mesa-build: '{}' has none of libEGL_mesa.so.0, libEGL.so.1, libGL.so.1 and "
                    "libOSMesa.so; name the folder "
                    "that meson built or installed Mesa into",
                    folder.string()));

  std::vector<std::string> folders;
  for (const auto& [name, path] : found)
    if (!is_driver(name) && std::ranges::find(folders, path.parent_path().string()) == folders.end())
      folders.push_back(path.parent_path().string());
  put_before("LD_LIBRARY_PATH", fmt::format("{}", fmt::join(folders, ":")));
  // Programs that are linked with libGL load the vendor when they start, even if they use EGL.
  if (!first("libGLX_mesa.so").empty()) setenv("__GLX_VENDOR_LIBRARY_NAME", "mesa", 1);

  const fs::path own = own_folder(folder);
  if (!vendor.empty()) {
    const fs::path file = own / "egl_vendor.json";
    std::ofstream(file) << fmt::format(
        R"({{"file_format_version": "1.0.0", "ICD": {{"library_path": "{}"}}}})", vendor.string());
    setenv("__EGL_VENDOR_LIBRARY_FILENAMES", file.c_str(), 1);
  }
  // An installation has a driver for each name; a build folder of Mesa up to 24.1 has one file for all.
  const fs::path all_drivers = first("libgallium_dri.so");
  fs::path drivers = first("swrast_dri.so").parent_path();
  if (drivers.empty() && !all_drivers.empty()) {
    drivers = own;
    for (const char* const name : {"swrast", "kms_swrast", "zink"}) {
      const fs::path link = own / fmt::format("{}_dri.so", name);
      std::error_code ignored;
      fs::remove(link, ignored);
      fs::create_symlink(all_drivers, link, ignored);
    }
  }
  if (!drivers.empty()) setenv("LIBGL_DRIVERS_PATH", drivers.c_str(), 1);
  setenv(kUsed, folder.c_str(), 1);
}

bool uses_mesa_build(const fs::path& folder) {
  const char* const used = std::getenv(kUsed);
  return used && folder == used;
}

void require_mesa_build(const fs::path& folder, const std::vector<std::string>& loaded) {
  const std::string inside = fs::canonical(folder).string() + "/";
  bool is_used = false;
  for (const std::string& file : loaded) {
    const std::string name = fs::path(file).filename().string();
    std::error_code unknown;
    const std::string path = fs::canonical(file, unknown).string();
    const bool is_in_folder = path.starts_with(inside);
    is_used = is_used || is_in_folder;
    if (!is_in_folder && (begins_with_one_of(name, kOfMesa) || is_driver(name)))
      throw CannotStart(
          fmt::format("--mesa-build: '{}' was loaded, which is not in '{}'; build the drivers and platforms "
                      "that are judged there "
                      "(gallium-drivers=llvmpipe or swrast)",
                      file, folder.string()));
  }
  if (!is_used)
    throw CannotStart(fmt::format("--mesa-build: no library of '{}' was loaded", folder.string()));
}

}  // namespace evalcts
