// The commands of evalcts-lab.
#pragma once

#include <evalcts/cli/command.h>

namespace evalcts::cli {

extern const Command kUlpCommand, kVectorsCommand, kConvertCommand;

}  // namespace evalcts::cli
