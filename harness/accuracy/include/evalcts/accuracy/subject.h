// Subjects of a measurement: GL implementations that are observed through a capture, and other evaluators of
// curves and surfaces.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <evalcts/accuracy/samples.h>
#include <evalcts/backends/implementation.h>

namespace evalcts::accuracy {

// Returns the names of the kinds of maps: "vertex_3", ... The colour index is missing, because no capture
// shows it.
std::vector<std::string> target_names();
// Returns the target of one of these names, such as GL_MAP1_VERTEX_3 or GL_MAP2_VERTEX_3.
GLenum target_of(const std::string& name, bool two_dimensional);

class Subject {
 public:
  virtual ~Subject() = default;
  virtual ImplementationInfo info() const = 0;
  // Returns the name of the capture that observes the results; empty if there is none.
  virtual std::string capture() const { return {}; }
  // Returns true if the results may depend on the target of a map.
  virtual bool has_targets() const { return true; }
  // Evaluates a map at the arguments (u[i], v[i]); v is empty for curves. Returns all components of the first
  // result, then those of the next. Throws NotObservable, for example if the subject cannot evaluate an
  // argument outside the domain or, over [0,1], one that is not a multiple of 2^-24.
  virtual std::vector<float> evaluate(GLenum target, const Map& map, std::span<const float> u,
                                      std::span<const float> v) = 0;
};

// Returns the names of the subjects that are not GL implementations: production-fast (libglevaluator's meshes
// with GLEV_FAST), and textbook algorithms in float or, rounded once, in double: casteljau (de Casteljau's
// construction), horner (Horner's scheme for Bernstein polynomials) and sum (the sum of all terms).
const std::vector<std::string>& own_subjects();

// Opens one of own_subjects() by its name, or an implementation. Throws CannotStart.
std::unique_ptr<Subject> open_subject(const ImplementationOptions& options);

// Makes one subject. make_textbook() returns null for a name that is not a textbook algorithm,
// make_captured() throws CannotStart.
std::unique_ptr<Subject> make_textbook(const std::string& name);
std::unique_ptr<Subject> make_production_fast();
std::unique_ptr<Subject> make_captured(const ImplementationOptions& options);

}  // namespace evalcts::accuracy
