// Tests Document.
#include "write/document.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace evalcts::vectors {
namespace {

TEST(Document, HasOneCaseALine) {
  Document document("grid", "Words.");
  document.explain("first", "one thing");
  document.explain("second", "another");
  document.add("grid.first.1", {"EV-A"}, {"first"}, {{"x", 1}});
  document.add("grid.second.1", {"EV-B", "EV-C"}, {"second"}, {{"x", 2}});
  document.add("grid.first.2", {"EV-A"}, {"first", "second"},
               {{"level", "advisory"}, {"since", "2.0"}, {"x", "\xC3\xA9"}});
  EXPECT_EQ(document.text(), R"({
 "format": "evalcts-vectors-1",
 "schemaVersion": "1.1",
 "generatorVersion": "3",
 "kind": "grid",
 "description": "Words.",
 "numberOfTests": 3,
 "notes": {
  "first": "one thing",
  "second": "another"
 },
 "cases": [
{"id":"grid.first.1","requirements":["EV-A"],"flags":["first"],"level":"must","since":"1.0","x":1},
{"id":"grid.second.1","requirements":["EV-B","EV-C"],"flags":["second"],"level":"must","since":"1.0","x":2},
{"id":"grid.first.2","requirements":["EV-A"],"flags":["first","second"],"level":"advisory","since":"2.0","x":"\u00e9"}
]}
)");
}

TEST(Document, RefusesWhatDoesNotHoldTogether) {
  Document document("grid", "Words.");
  document.explain("theme", "meaning");
  EXPECT_THROW(document.add("grid.theme.1", {"EV-A"}, {"unexplained"}, {{"x", 1}}), std::logic_error);
  EXPECT_THROW(document.explain("theme", "another meaning"), std::logic_error);
  document.add("grid.theme.1", {"EV-A"}, {"theme"}, {{"x", 1}});
  EXPECT_THROW(document.add("grid.theme.1", {"EV-A"}, {"theme"}, {{"x", 1}}), std::logic_error);
}

}  // namespace
}  // namespace evalcts::vectors
