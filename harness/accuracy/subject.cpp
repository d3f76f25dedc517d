// Defines the targets of maps and the list of subjects, and opens subjects.
#include <evalcts/accuracy/subject.h>

namespace evalcts::accuracy {
namespace {

struct Target {
  const char* name;
  GLenum one, two;
};

constexpr Target kTargets[] = {
    {"vertex_3", GL_MAP1_VERTEX_3, GL_MAP2_VERTEX_3},
    {"vertex_4", GL_MAP1_VERTEX_4, GL_MAP2_VERTEX_4},
    {"color_4", GL_MAP1_COLOR_4, GL_MAP2_COLOR_4},
    {"normal", GL_MAP1_NORMAL, GL_MAP2_NORMAL},
    {"texture_coord_1", GL_MAP1_TEXTURE_COORD_1, GL_MAP2_TEXTURE_COORD_1},
    {"texture_coord_2", GL_MAP1_TEXTURE_COORD_2, GL_MAP2_TEXTURE_COORD_2},
    {"texture_coord_3", GL_MAP1_TEXTURE_COORD_3, GL_MAP2_TEXTURE_COORD_3},
    {"texture_coord_4", GL_MAP1_TEXTURE_COORD_4, GL_MAP2_TEXTURE_COORD_4},
};

}  // namespace

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const Target& target : kTargets) names.emplace_back(target.name);
  return names;
}

GLenum target_of(const std::string& name, bool two_dimensional) {
  for (const Target& target : kTargets)
    if (name == target.name) return two_dimensional ? target.two : target.one;
  throw std::invalid_argument("unknown target " + name);
}

const std::vector<std::string>& own_subjects() {
  static const std::vector<std::string> kAll = {"production-fast", "casteljau-float", "casteljau-double",
                                                "horner-float",    "horner-double",   "sum-float",
                                                "sum-double"};
  return kAll;
}

std::unique_ptr<Subject> open_subject(const ImplementationOptions& options) {
  if (options.library.empty() && options.context.empty()) {
    if (options.name == "production-fast") return make_production_fast();
    if (auto textbook = make_textbook(options.name)) return textbook;
  }
  return make_captured(options);
}

}  // namespace evalcts::accuracy
