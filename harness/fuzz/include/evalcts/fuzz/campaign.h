// Judges random programs on one implementation, in this process.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include <evalcts/fuzz/finding.h>

namespace evalcts::fuzz {

// A random program to judge: the data of a job of a worker.
struct RandomJob {
  std::uint32_t number = 0;  // of the program
  int length = 120;          // approximate number of commands
  double seconds = 0;        // time limit of a reduction; 0: none
  // True: the program has its own context. False: most programs of a worker share a context, if the
  // implementation can create it beside others. Creating a context and its shaders takes most of the time of
  // a program. A difference in the shared context must be reproduced in a fresh context, alone or after some
  // of the earlier programs.
  bool in_fresh_context = false;
  std::vector<std::string> deadly = {};  // candidates (JSON) in which the library has died; not run again
};

struct CampaignStarted {
  int max_eval_order = 8;  // the limit with which programs are made
};
// A candidate of a reduction, before it runs, so that it is known if the library dies in it.
struct CandidateStarted {
  std::uint32_t number = 0;  // of the random program
  std::string program;       // JSON text; empty: the latest candidate has ended
};
// A smaller program of the finding that is being reduced.
struct FindingShrank {
  std::uint32_t number = 0;  // of the random program
  Finding finding;
};
struct FindingMade {
  std::uint32_t number = 0;
  Finding finding;
};
struct ProgramJudged {
  bool judged = true;   // at least some effects could be observed
  bool in_full = true;  // all effects could be observed
  std::uint64_t commands = 0;
  bool not_repeated = false;    // the program differed only in the shared context
  double seconds_of_known = 0;  // time spent on a difference without a new cause
};
using CampaignEvent =
    std::variant<CampaignStarted, CandidateStarted, FindingShrank, FindingMade, ProgramJudged>;

// Returns a function that judges the program of a job, and reports ProgramJudged after its findings. It
// reports CampaignStarted at once. Commands that the implementation does not provide are left out of the
// programs. `subject` must outlive the function.
std::function<void(const RandomJob&)> campaign(const Subject& subject,
                                               const std::function<void(const CampaignEvent& event)>& report);

}  // namespace evalcts::fuzz
