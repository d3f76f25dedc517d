// Tests the accuracy page with and without pictures, and with untrusted strings.
#include <gtest/gtest.h>

#include "evalcts/accuracy_page.h"
#include "evalcts/reports.h"

namespace evalcts::reports {
namespace {

using nlohmann::json;

json ulp_of(const std::string& name) {
  json histogram = json::array(), along = json::array();
  for (int i = 0; i < 25; ++i) histogram.push_back(i < 3 ? 100 : 0);
  for (int i = 0; i < 256; ++i) along.push_back(i == 128 ? json(nullptr) : json(0.5));
  const json number = {{"value", "0x1p+0"}, {"bits", "0x3f800000"}};
  const json worst = {{"error", 12.5},
                      {"found_by", "climbing"},
                      {"orders", {4}},
                      {"points", {"0x1p+0", "0x1p+0"}},
                      {"at", {"0x1p-1"}},
                      {"got", number},
                      {"right", number},
                      {"exact", "1 (0x1p+0)"},
                      {"replay", {"evalcts", "ulp", "a 'b'"}}};
  json rows = json::array();
  for (const int order : {2, 4})
    rows.push_back({{"name", "curve/" + std::to_string(order) + "/ordinary"},
                    {"orders", {order}},
                    {"data", "ordinary"},
                    {"seed", 1},
                    {"target", "vertex_3"},
                    {"proven", false},
                    {"values", 300},
                    {"not_correctly_rounded", 200},
                    {"not_finite", 0},
                    {"max_ulp", 12.5},
                    {"mean_ulp", 1.5},
                    {"max_condition_aware", nullptr},
                    {"mean_condition_aware", 0.5},
                    {"climbed", 300},
                    {"sample_max_ulp", 11},
                    {"sample_max_condition_aware", 3},
                    {"histogram", histogram},
                    {"zeros", {{"values", 0}, {"wrong", 0}}},
                    {"without_terms", {{"values", 0}, {"wrong", 0}}},
                    {"worst_ulp", worst},
                    {"worst_condition_aware", worst}});
  rows.push_back({{"name", "curve/30/ordinary"},
                  {"orders", {30}},
                  {"data", "ordinary"},
                  {"seed", 1},
                  {"not_measured", "GL_MAX_EVAL_ORDER is 8"}});
  return {{"format", "evalcts-ulp-1"},
          {"evalcts_version", "0"},
          {"command", "evalcts ulp"},
          {"status", "complete"},
          {"seed", 1},
          {"targets", {"vertex_3"}},
          {"curves", {{{"name", "Cubic 1"}, {"what", "a cubic"}, {"points", {"0x1p+0"}}, {"zeros", {0.25}}}}},
          {"implementations",
           {{{"name", name},
             {"status", "complete"},
             {"rows", rows},
             {"profiles", {{{"name", "Cubic 1"}, {"max_ulp", along}, {"max_condition_aware", along}}}}}}}};
}

// Returns an SVG like gnuplot's: with a head, colours in both formats, and IDs that are the same in all
// pictures.
std::string svg_of(const std::string& text) {
  return "<?xml version=\"1.0\"?>\n<svg \n viewBox=\"0 0 9 9\"\n>\n<title>x</title>\n<desc>y</desc>\n"
         "<g id=\"gnuplot_canvas\"><g id=\"histograms_plot_1\" >"
         "<circle id='gpDot'/></g><use xlink:href='#gpDot'/>"
         "<path stroke='rgb(  4,   4,   4)'/><text fill=\"rgb(1,1,1)\">" +
         text + "</text></g>\n</svg>\n";
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(AccuracyPage, HasPicturesInIt) {
  std::vector<std::string> scripts;
  const std::string page = accuracy_html(ulp_of("osmesa"), {}, [&](const std::string& script) {
    scripts.push_back(script);
    return svg_of("@0@");
  });
  ASSERT_EQ(scripts.size(), 3u) << "by order, over u, histograms";
  EXPECT_EQ(count_of(page, "<svg"), 3u);
  EXPECT_EQ(page.find("<?xml"), std::string::npos);
  EXPECT_EQ(page.find("<title>x"), std::string::npos);
  for (const char* id : {"id='by_order_ordinary_gpDot'", "id='over_u__ubic_1_gpDot'", "id='histograms_gpDot'",
                         "href='#histograms_gpDot'", "id=\"histograms_gnuplot_canvas\""})
    EXPECT_EQ(count_of(page, id), 1u) << id;
  EXPECT_EQ(count_of(page, "id='gpDot'"), 0u);
  EXPECT_EQ(count_of(page, "id=\"histograms_plot_1\""), 2u)
      << "gone from the histograms, not from where it is alone";
  EXPECT_EQ(count_of(page, "stroke='var(--ulp)'"), 3u);
  EXPECT_EQ(count_of(page, "<text fill=\"var(--text)\">osmesa</text>"), 3u);
  EXPECT_EQ(count_of(page, "role=\"img\" aria-label="), 3u);
  EXPECT_EQ(page.find("No pictures"), std::string::npos);
  // An infinite error is drawn at the top of the scale, and a zero of the curve is marked.
  EXPECT_NE(scripts[1].find("0.5019531 1e+09 1e+09"), std::string::npos) << scripts[1];
  EXPECT_NE(scripts[1].find("set arrow from 0.25,graph 0"), std::string::npos);
}

TEST(AccuracyPage, SaysWhatIsMissingWithoutPictures) {
  for (const Draw& draw : {Draw(), Draw([](const std::string&) { return std::nullopt; }),
                           Draw([](const std::string&) { return std::string("broken"); })}) {
    const std::string page = accuracy_html(ulp_of("osmesa"), {}, draw);
    EXPECT_NE(page.find("No pictures"), std::string::npos);
    EXPECT_EQ(page.find("<figure"), std::string::npos);
    EXPECT_NE(page.find("66.67 %<br>inf</td>"), std::string::npos);
    EXPECT_NE(page.find("title=\"GL_MAX_EVAL_ORDER is 8\""), std::string::npos);
  }
}

TEST(AccuracyPage, LoadsNothingAndEscapes) {
  const std::string evil = "<script>alert('1')</script>\"&\n@0@";
  std::vector<std::string> scripts;
  const std::string page = accuracy_html(ulp_of(evil), {}, [&](const std::string& script) {
    scripts.push_back(script);
    return svg_of("@0@");
  });
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
  for (const std::string& script : scripts) EXPECT_EQ(script.find("alert"), std::string::npos);
  EXPECT_EQ(page.find("src="), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(accuracy_html(ulp_of(evil), {}, {}), accuracy_html(ulp_of(evil), {}, {}));
}

TEST(AccuracyPage, ShowsWhatIsProven) {
  json sweep = {{"format", "evalcts-sweep-1"},
                {"implementation", {{"kind", "production"}}},
                {"points", {"0x1p+0", "0x1p+1"}},
                {"interval", {"0x0p+0", "0x1p+0"}},
                {"shard", "1/1"},
                {"status", "complete"},
                {"proven", true},
                {"result",
                 {{"values", 1065353217},
                  {"not_correctly_rounded", 7},
                  {"worst_ulp", {{"error", 2.5}, {"at", "0x1p-3"}}},
                  {"worst_condition_aware", nullptr},
                  {"digest", "0123456789abcdef"}}}};
  const std::string page = accuracy_html(ulp_of("osmesa"), {sweep}, {});
  EXPECT_NE(page.find("<td>proven</td>"), std::string::npos);
  EXPECT_NE(page.find("2.5 at 0x1p-3"), std::string::npos);
  EXPECT_NE(page.find("0123456789abcdef"), std::string::npos);
  sweep["proven"] = false;
  sweep["status"] = "unfinished";
  EXPECT_NE(accuracy_html(ulp_of("osmesa"), {sweep}, {}).find("<td>largest found: unfinished</td>"),
            std::string::npos);
  sweep["format"] = "evalcts-sweep-9";
  EXPECT_THROW(accuracy_html(ulp_of("osmesa"), {sweep}, {}), FormatError);
  EXPECT_THROW(accuracy_html({{"format", "another"}}, {}, {}), FormatError);
}

TEST(AccuracyCsv, HasALineForEachNumber) {
  const json ulp = ulp_of("a \"b\", c");
  const std::string quoted = "\"a \"\"b\"\", c\"";
  EXPECT_EQ(count_of(table_csv(ulp), "\n" + quoted + ",curve/"), 2u);
  EXPECT_NE(table_csv(ulp).find(",12.5,1.5,inf,0.5,0,0,0,0,no,11,3,climbing,climbing\n"), std::string::npos)
      << table_csv(ulp);
  EXPECT_EQ(count_of(histograms_csv(ulp), "\n"), 1 + 2 * 25u);
  EXPECT_NE(histograms_csv(ulp).find("vertex_3,0.5,100\n"), std::string::npos);
  EXPECT_EQ(count_of(profiles_csv(ulp), "\n"), 1 + 256u);
  EXPECT_NE(profiles_csv(ulp).find("Cubic 1,0.5,0.50390625,inf,inf\n"), std::string::npos);
  EXPECT_EQ(count_of(worst_csv(ulp), "\n"), 1 + 2 * 2u);
}

}  // namespace
}  // namespace evalcts::reports
