// Names of commands under the extensions that they come from, for the table of entry points and for C
// programs.
#pragma once

#include <string>
#include <string_view>

namespace evalcts::gl {

// Returns the name of the command in the extension that it was promoted from, such as glActiveTextureARB;
// empty if there is none.
std::string name_in_extension(std::string_view name);

}  // namespace evalcts::gl
