// The session of a process with one implementation: opens it when a job needs it, and runs tests on it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <evalcts/backends/reused_context.h>
#include <evalcts/capture/observed_values.h>
#include <evalcts/results/serialization.h>
#include <evalcts/suite/suite_main.h>
#include <evalcts/testkit/registration.h>
#include <evalcts/testkit/reproduction.h>
#include <evalcts/testkit/test.h>

namespace evalcts {

struct SessionOptions {
  ImplementationOptions implementation;
  std::optional<std::vector<std::string>> captures;  // the captures to use; none: all
  std::vector<std::string> readings;                 // NAME=READING
  std::vector<std::string> omitted_calls;            // texts of gl::call_text() of commands that crash
  Depth depth = Depth::kFull;
  std::uint32_t seed = 1;
  bool reuse_context = false;           // all cases share a context
  bool warm = false;                    // tests run in a warm context first
  std::optional<gl::CStyle> reproduce;  // report the running case as a C program in this style
};

class Session {
 public:
  // Opens nothing yet. `wrapping`: see suite_main(). `report`: called with events of tests. Both must outlive
  // the object.
  Session(SessionOptions options, const Wrapping& wrapping, const std::function<void(const Event&)>& report);
  // Destroys all contexts. This must happen before static destructors run, because Mesa would hang.
  void close();

  // The functions below throw CannotStart if the implementation does not start.

  // Opens all that tests need, so that a library that dies of it dies before its first test.
  void open_for_tests();
  Description describe();
  // Proves the capture with this name. Throws std::runtime_error if there is none.
  CaptureRecord prove(const std::string& capture);
  // Runs a test, and restores what the library changes in the process. `job`: how; see Job.
  TestRecord run_test(const TestInfo& test, const Job& job = {});
  // Runs the program of the job as a test with the name "program".
  TestRecord run_program(const Job& job);
  // Reports the values of a program's vertices.
  void observe(const ValuesRequest& request);
  // Returns the subject for programs other than tests.
  const Subject& subject();

 private:
  void open();
  void open_captures();
  void run_warm_then_fresh(const TestInfo& test, const Job& job, TestRecord& record);
  void run_on(const Subject& subject, const TestInfo& test, const Job& job, TestRecord& record);
  bool passes_in_warm_context(const TestInfo& test, const Job& job, TestRecord& record);
  void begin_case(const gl::Case& script, const Job& job);
  void keep_failing_case();

  const SessionOptions options_;
  const Wrapping& wrapping_;
  const std::function<void(const Event&)>& report_;
  std::unique_ptr<Implementation> implementation_;
  std::unique_ptr<Implementation> reused_;  // set if all tests share a context
  std::unique_ptr<WarmContext> warm_;       // set if tests run in a warm context first
  std::unique_ptr<Captures> captures_;
  std::unique_ptr<Reproduction> reproduction_;
  Subject subject_;
  bool is_open_for_tests_ = false;
  std::uint64_t cases_left_ = 0;        // number of cases that the running test may still run
  const TestRecord* record_ = nullptr;  // of the running test
  gl::Case latest_case_;                // of the running test
  std::string failing_case_;            // the first failing case of the test as JSON text; empty: none yet
};

}  // namespace evalcts
