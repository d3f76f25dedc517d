// The program evalcts.
#include <evalcts/cli/command_line.h>

int main(int argc, char** argv) {
  using namespace evalcts::cli;
  return command_line(argc, argv,
                      {kRunCommand, kBugsCommand, kListCommand, kCoverageCommand, kExplainCommand,
                       kReproduceCommand, kReportCommand, kWaiveCommand, kCheckCommand, kRecordCommand,
                       kFaultsCommand, kFuzzCommand, kUlp, kVectors, kConvert});
}
