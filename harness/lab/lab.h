// The commands of evalcts-lab.
#pragma once

#include <evalcts/cli/command.h>

namespace evalcts::cli {

extern const Command kRoundingCommand, kUlpCommand, kVectorsCommand;

}  // namespace evalcts::cli
