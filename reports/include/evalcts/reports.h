// Pages from results: values of C++ types in, text out. Nothing else is read, no file
// is written, no clock is asked, so the same input always gives the same bytes.
//
// Results may be compared with earlier ones, `before`: those of one name, the first with the first and so on;
// a single result on either side with the other, whatever they are called. A regression is a test that fails,
// crashes, hangs or ends in an internal error and did not before, or not as badly, or (where depth and seed
// are the same) not in all the cases in which it fails now; and an implementation that no longer starts.
//
// Distances are in ULP of binary32 (Harrison's definition) and, beside them, in units of 2^-24 * sum |B_i|
// |R_i|.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/results/requirements.h>
#include <evalcts/results/run_result.h>

namespace evalcts::reports {

struct PageOptions {
  std::vector<RunResult> before;  // earlier results; empty: nothing is compared
  bool accuracy_page = false;     // whether accuracy.html lies beside the page
};

// One self-contained HTML page that compares any number of records (none gives a page that says so). It opens
// from disk, loads nothing, and reads without JavaScript.
// catalogue: for the texts beside the IDs; may be empty.
std::string html(const std::vector<RunResult>& results, const Catalogue& catalogue,
                 const PageOptions& options = {});

// A short summary in GitHub's and GitLab's Markdown, for a pull request: counts for each record, changes, the
// distinct bugs, the unexpected failures (at most ten of each record). Text of a record stands in code spans
// only, so that it cannot become markup or a mention.
std::string markdown_summary(const std::vector<RunResult>& results,
                             const std::vector<RunResult>& before = {});

// Requirements by record in Markdown: each requirement with a failing test, with the number of failing and of
// decided tests in each record, and each test whose verdict is not the same in all records. catalogue: as
// for html.
std::string requirements_table(const std::vector<RunResult>& results, const Catalogue& catalogue);

// The changes for a terminal, at most eight of each kind, on lines of 100 columns, and how many regressions
// there are.
struct Changes {
  std::string text;
  std::uint64_t regressions = 0;
};
Changes changes(const std::vector<RunResult>& results, const std::vector<RunResult>& before);

// Puts the shards of one run ("shard": "K-of-N") together: those with the same name, pass, depth, seed and N;
// of several that are the same shard, each is of another run, those of one origin of the same. The result
// stands where the first of them stood, its tests in the order of a run that is not sharded; where shards are
// missing it is "interrupted" and says which. Throws FormatError, also where the shards judged libraries that
// call themselves differently.
std::vector<RunResult> merge_shards(const std::vector<RunResult>& results);

// One JUnit XML document as Jenkins and GitLab read it: a testsuite named after the implementation, each test
// a testcase "IMPLEMENTATION.Theme" / "Test/parameters".
//   fail -> failure; crash, timeout, internal-error -> error; not-supported, not-observable, skipped ->
//   skipped; a fail, crash or timeout that the baseline expects -> skipped, with the baseline's reason; pass
//   and quality-warning -> passed, the warning in system-out.
// A run that stopped early (status other than complete and not-started) adds a testcase with an error, so
// that it never looks whole; a run that never started is one skipped testcase.
std::string junit(const RunResult& result);

// Text to read first after a run, worst first: counts, then the distinct bugs, most important first; if they
// were not looked for, or with verbose, each unexpected failure in five lines (the test
// and its case; what was expected and what came; which requirement says so; the command that runs just it;
// the commands that open it in a debugger and make a C program of it), one of each requirement before the
// second of any. Without verbose at most 8 failures, on lines of 100 columns; the commands are never cut.
// With verbose all unexpected failures, all their recorded cases, those that the baseline expects (one line
// each), and what was not judged and why. catalogue: as for html. colour: ANSI colour sequences; the words
// stand there with and without. lines: of the screen, where less than 8 failures may fit on it; 0: unknown.
// Ends with a newline.
std::string terminal_summary(const RunResult& result, const Catalogue& catalogue, bool colour, bool verbose,
                             std::size_t lines = 0);

// The distinct bugs of a run for a terminal, most important first: each with its requirements, what was
// expected and captured, its minimal program as C, and at most 5 of the tests that it explains (verbose:
// all).
std::string bug_list(const RunResult& result, const Catalogue& catalogue, bool colour, bool verbose);

// The result in one line: "osmesa: 3 unexpected results, 408 failing tests as the baseline expects".
// Ends with a newline.
std::string terminal_line(const RunResult& result, bool colour);

}  // namespace evalcts::reports
