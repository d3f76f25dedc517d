// Defines the class Conditions, which a test asks before it writes a program.
#pragma once

#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/gl/case.h>
#include <evalcts/gl/delivery.h>
#include <evalcts/results/test_record.h>
#include <evalcts/testkit/subject.h>

namespace evalcts {

// Thrown if a requirement does not apply to the implementation, because its version or extension is not
// supported, or because the implementation is a sink that does not declare the feature.
struct NotSupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Ends a test in a warm context, which runs again in fresh contexts. No NotObservable, because tests may
// catch those.
struct FreshContextsDecide : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The conditions under which a test writes its programs: the implementation, the depth, the form of delivery
// and random numbers. What a test leaves out is recorded as not observed.
class Conditions {
 public:
  const ImplementationInfo& gl() const { return subject_.info; }
  // Returns the largest order that the implementation must accept (see ImplementationInfo).
  int max_order() const { return gl().max_order(); }
  // Returns the number of texture units that tests use, 1 to 8.
  int texture_units() const;
  // Returns the order above which all orders must be rejected. Throws NotObservable if MAX_EVAL_ORDER is not
  // answered, because the limit may then be any order from 8 on.
  int order_limit() const;
  // Returns the depth of the run. At full depth, returns quick for deliveries that are not plain, because
  // these only have to show that they have the same effect.
  Depth depth() const;
  // Returns the value for the depth.
  int by_depth(int quick, int full, int thorough) const;
  // Returns the random numbers of this test, which are the same for the same seed, regardless of other tests.
  std::mt19937& random() { return random_; }
  // True if the cases of this test go through display lists.
  bool is_delivered_in_lists() const { return delivery_.lists != gl::Lists::kNone; }

  // Throws NotSupported below the version unless the extension is advertised.
  void require(int major, int minor, const std::string& or_extension = {}) const;
  // Makes the test run in fresh contexts only, if the implementation has them: restored state may hide what
  // the test is about.
  void prefer_fresh_contexts() const;
  // Throws NotObservable if cases do not begin in a fresh context, but in one whose state was
  // restored by commands.
  void require_initial_state() const;

  // Returns true if the implementation has the command. If it is missing, records it as not observed, so that
  // a pass covers only the rest of the test. For tests that use several forms of a command and can judge each
  // without the others.
  bool can_call(gl::EntryPoint command);
  // The same for the query of a grid by Get, which an implementation may reject.
  bool can_query_grid(GLenum name);
  // Appends optional commands, except those that are missing or crash the implementation, which are noted in
  // the record. Returns the position of each command; -1 if it was left out. No command may use the result of
  // another. Throws NotObservable if none is left.
  std::vector<gl::Ref> append_optional(gl::Case& c, const gl::Case& optional);

 protected:
  Conditions(const Subject& subject, TestRecord& record) : subject_(subject), record_(record) {}

  const Subject& subject_;
  TestRecord& record_;
  gl::Delivery delivery_;
  // The commands and queries that can_call() and can_query_grid() found missing: "glMap1d (missing)".
  std::set<std::string> missing_;
  std::mt19937 random_;
};

}  // namespace evalcts
