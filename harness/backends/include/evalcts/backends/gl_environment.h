// Environment variables that decide which GL driver a library loads.
#pragma once

#include <string>
#include <vector>

namespace evalcts {

// Returns a clause for a message about a GL that does not start: the variables that are set and point Mesa,
// libglvnd or Vulkan to a driver, with their values and with the files and directories among them that cannot
// be used. Begins with "; "; empty if no such variable is set.
std::string describe_gl_environment();

// Returns a clause that names the EGL vendor libraries that libglvnd is configured to load and cannot load,
// with the reasons, which libglvnd itself does not print. Begins with "; "; empty if there are none.
std::string describe_egl_vendors();

// Returns the paths of the libraries of GL, EGL, GLX and Vulkan and of the drivers that this process has
// loaded.
std::vector<std::string> loaded_gl_files();

// Returns a sentence if GALLIUM_DRIVER or MESA_LOADER_DRIVER_OVERRIDE asks for one driver and GL_RENDERER
// shows another one; otherwise an empty string. Drivers whose renderer strings do not contain their names
// (those of hardware) are recognized only if a software driver answers in their place.
std::string describe_other_driver(const std::string& renderer);

}  // namespace evalcts
