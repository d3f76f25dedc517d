// Pages and other texts from results. The functions use no other input (no files, no clock), so the same
// results always give the same bytes.
//
// Results may be compared with earlier ones, `before`. Results of the same name are paired, the first with
// the first and so on; if there is one result on each side, these two are compared whatever their names are.
// A regression is a test that fails, crashes, hangs or ends in an internal error, and earlier did not, or had
// a less severe verdict, or (if depth and seed are the same) did not fail in all cases in which it fails now.
// An implementation that no longer starts is a regression, too.
//
// Distances are given in ULP of binary32 (Harrison's definition) and in units of 2^-24 * sum |B_i| |R_i|.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/history.h>
#include <evalcts/results/requirements.h>
#include <evalcts/results/run_result.h>

namespace evalcts::reports {

struct PageOptions {
  std::vector<RunResult> before;  // earlier results; empty: nothing is compared
  std::vector<PastRun> history;   // the runs of the section History; empty: there is none
  // Paths of the files of each result, relative to the page, to which it links.
  std::vector<std::vector<std::string>> files = {};
  std::string sources = {};  // address of the repository, for links to tests; empty: there are no links
};

// Returns one self-contained HTML page that compares any number of records (without records, the page says
// so). It opens from disk, loads nothing, and can be read without JavaScript.
// catalogue: for the texts of the requirements; may be empty.
std::string html(const std::vector<RunResult>& results, const Catalogue& catalogue,
                 const PageOptions& options = {});

// Returns a short summary in GitHub's and GitLab's Markdown, for a pull request: counts and the conclusion of
// each record, changes, the distinct bugs, and the unexpected failures (at most ten of each record). Text of
// a record is in code spans only, so that it cannot become markup or a mention.
std::string markdown_summary(const std::vector<RunResult>& results,
                             const std::vector<RunResult>& before = {});

// Returns a table of requirements by record in Markdown: each requirement with a failing test, with the
// number of failing and of decided tests in each record, and each test whose verdict is not the same in all
// records. catalogue: as for html.
std::string requirements_table(const std::vector<RunResult>& results, const Catalogue& catalogue);

// The changes for a terminal, at most eight of each kind, on lines of at most `columns` (0: any length), and
// the number of regressions.
struct Changes {
  std::string text;
  std::uint64_t regressions = 0;
};
Changes changes(const std::vector<RunResult>& results, const std::vector<RunResult>& before,
                std::size_t columns = 0);

// Merges the shards of each run ("shard": "K-of-N"); other results are returned as they are. Shards with the
// same name, pass, depth, seed and N are of one run, unless they have the same K; then shards of the same
// origin are merged. A merged result takes the place of its first shard and has its tests in the order of an
// unsharded run. If shards are missing, it is "interrupted", and its reason names them. Throws FormatError if
// the shards of a run differ in vendor, renderer or version.
std::vector<RunResult> merge_shards(const std::vector<RunResult>& results);

// Returns one JUnit XML document as Jenkins and GitLab read it: a testsuite named after the implementation,
// with a testcase "IMPLEMENTATION.Theme" / "Test/parameters" for each test. The verdicts become:
//   fail -> failure; crash, timeout, internal-error -> error; not-supported, not-observable, skipped ->
//   skipped; a fail, crash or timeout that the baseline expects -> skipped, with the baseline's reason; pass
//   and quality-warning -> passed, the warning in system-out.
// A run that stopped early (status other than complete and not-started) gets one more testcase with an error,
// so that it does not look complete; a run that never started is one skipped testcase.
std::string junit(const RunResult& result);

// Returns the new failures, one for each bug, as error annotations: commands of GitHub's workflows, at most
// ten, which GitHub shows beside the log. Empty if there is none.
std::string github_annotations(const std::vector<RunResult>& results);
// Returns the same as a report of GitLab's code quality, at the first line of the file, a path in the
// repository.
std::string gitlab_code_quality(const std::vector<RunResult>& results, const std::string& file);

// Returns the text to read first after a run: counts, then the distinct bugs, most important first. If bugs
// were not looked for, or with `verbose`, it has each unexpected failure in five lines: the test and its
// case; the expected and the captured value; the requirement; the command that runs only this test; the
// commands that open it in a debugger and write it as a C program. The worst are first, but one of each
// requirement comes before the second of any. Without `verbose` there are at most 8 failures. With `verbose`
// there are all unexpected failures with all their recorded cases, the failures that the baseline expects
// (one line each), and the tests that were not judged, with the reasons. catalogue: as for html. colour: true
// to add ANSI colour sequences; the words are the same. lines, columns: size of the screen, on which fewer
// than 8 failures may fit, and at which lines except commands are broken; 0: unknown. The text ends with a
// newline.
std::string terminal_summary(const RunResult& result, const Catalogue& catalogue, bool colour, bool verbose,
                             std::size_t lines = 0, std::size_t columns = 0);

// Returns the distinct bugs of a run for a terminal, most important first: each with its requirements, the
// expected and the captured value, its minimal program as C, and at most 5 of the tests that it explains
// (verbose: all).
std::string bug_list(const RunResult& result, const Catalogue& catalogue, bool colour, bool verbose);

// Returns the result in one line: "osmesa: 3 new failures; 408 known (baseline mesa)", with a newline at the
// end.
std::string terminal_line(const RunResult& result, bool colour);

}  // namespace evalcts::reports
