// Judges the Mesa of a build or installation folder in place of the system's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace evalcts {

// Sets the environment so that EGL, GLX and OSMesa come from a folder: a build folder of meson, of which
// nothing was installed, or an installation; with libglvnd or without. LD_LIBRARY_PATH only affects programs
// that start afterwards. Links and a vendor file, which a build folder lacks, are written into a folder of
// the user below the temporary directory. Throws CannotStart if the folder has no Mesa.
void use_mesa_build(const std::filesystem::path& folder);

// Returns true if this program was started with the environment that use_mesa_build() sets for the folder.
bool uses_mesa_build(const std::filesystem::path& folder);

// Throws CannotStart if one of the loaded files (loaded_gl_files()) is a library or driver of Mesa that is
// not in the folder, or none of them is.
void require_mesa_build(const std::filesystem::path& folder, const std::vector<std::string>& loaded);

}  // namespace evalcts
