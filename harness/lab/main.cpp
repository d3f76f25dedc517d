// The program evalcts-lab.
#include <evalcts/cli/command_line.h>

#include "lab.h"

int main(int argc, char** argv) {
  using namespace evalcts::cli;
  return command_line(argc, argv, {kUlpCommand, kVectorsCommand, kConvertCommand});
}
