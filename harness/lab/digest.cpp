// `evalcts ulp --digest`: prints one line with a digest of millions of results.
#include <fmt/format.h>

#include <iostream>

#include <evalcts/accuracy/digest.h>
#include <evalcts/cli/terminal.h>
#include <evalcts/results/files.h>
#include <evalcts/results/text.h>
#include <evalcts/runner/interruption.h>
#include "ulp.h"

namespace evalcts::cli {

int digest(const UlpOptions& options) {
  UlpOptions chosen = options;
  if (chosen.implementations.empty() && options.library.empty() && options.context.empty())
    chosen.implementations.emplace_back("production");
  if (chosen.implementations.size() > 1)
    return wrong_use("--digest measures one implementation: give only one");
  stop_when_asked();
  try {
    const accuracy::StreamSource source = accuracy::stream_source(implementation_of(chosen));
    const std::uint64_t values = options.values.value_or(kValuesOfDigest);
    const std::uint64_t sum =
        accuracy::digest(source, {values, options.seed, options.jobs.value_or(usual_jobs())}, interrupted);
    if (interrupted) return wrong_use("interrupted");
    std::cout << fmt::format("digest {:016x} of {} results, seed {}: {} {} {}\n", sum, values, options.seed,
                             source.info.name, clean(source.info.renderer), clean(source.info.version));
    return kNothingUnexpected;
  } catch (const CannotStart& reason) {
    return wrong_use(reason.what());
  } catch (const NotObservable& reason) {
    return wrong_use(reason.what());
  }
}

}  // namespace evalcts::cli
