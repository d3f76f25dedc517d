// Subjects of a measurement: implementations of the GL through a capture, and evaluators of curves and
// surfaces that are no GL.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>
#include <evalcts/backends/implementation.h>
#include <evalcts/gl/observation.h>
#include <evalcts/gl/table.h>

namespace evalcts::accuracy {

// The names of the kinds of maps: "vertex_3", ..., without the colour index, which no capture shows.
std::vector<std::string> target_names();
// GL_MAP1_VERTEX_3 or GL_MAP2_VERTEX_3. Throws std::invalid_argument for a name that is none of them.
GLenum target_of(const std::string& name, bool two_dimensional);

class Subject {
 public:
  virtual ~Subject() = default;
  virtual ImplementationInfo info() const = 0;
  // The name of the capture that shows its results; empty if there is none.
  virtual std::string capture() const { return {}; }
  // True if the target of a map makes a difference to it.
  virtual bool has_targets() const { return true; }
  // Components of control points of the map come one after the other, v fastest. u and v lie in its domain;
  // over [0,1] they are multiples of 2^-24. v is empty for curves. The results hold all components of the
  // first argument, then those of the next. Throws NotObservable.
  virtual void evaluate(GLenum target, const Map& map, std::span<const float> u, std::span<const float> v,
                        std::span<float> results) = 0;
};

struct SubjectKind {
  std::string name, what;
};
// Subjects that are no GL implementations: production-fast, and algorithms of textbooks.
const std::vector<SubjectKind>& own_subjects();

// One of those by its name, or an implementation. Throws CannotStart.
std::unique_ptr<Subject> open_subject(const ImplementationOptions& options);

// Null where there is no such.
std::unique_ptr<Subject> make_textbook(const std::string& name);
std::unique_ptr<Subject> make_production_fast();
std::unique_ptr<Subject> make_captured(const ImplementationOptions& options);

}  // namespace evalcts::accuracy
