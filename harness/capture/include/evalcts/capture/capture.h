// Captures: ways to observe the vertices that an evaluator emits. A capture wraps a case in commands of its
// own, runs it in a fresh context, once for each pass that it needs, and decodes the output.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/observation.h>
#include <evalcts/gl/player.h>

namespace evalcts {

// Requirements of an observation.
struct CaptureRequest {
  Attributes attributes = 0;       // attributes to observe; more may be observed
  std::size_t most_vertices = 0;   // largest number of captured vertices; more set Observation::overflow
  PrimitiveKinds kinds = kPoints;  // kinds of primitives that the case draws
  bool nothing_more = false;       // observe only these attributes, with as few commands as possible
};

class Capture {
 public:
  virtual ~Capture() = default;
  virtual std::string name() const = 0;

  // Tests the capture on a control of explicit Vertex, Color, Normal and TexCoord commands, and determines
  // which attributes it can observe on this implementation. Throws NotObservable if the capture cannot be
  // used. Must be called once, before observe().
  virtual void prove(Implementation& implementation, const ImplementationInfo& info) = 0;

  // Attributes that the capture reproduces bit for bit; valid after prove().
  virtual Attributes attributes() const = 0;

  // Further attributes, reproduced up to an error that each observation states (Observation::color_error);
  // valid after prove().
  virtual Attributes inexact_attributes() const { return 0; }

  // All attributes that observations show, exact or not; valid after prove().
  Attributes shown() const { return attributes() | inexact_attributes(); }

  // Returns the subset of the wanted attributes that observations show, exact or not. If a kind of normals
  // (kUnitNormal, kShaderNormal) is wanted but not shown, the result has no normals.
  Attributes shown_of(Attributes wanted) const;

  // True if vertices with w <= 0 are lost; valid after prove().
  virtual bool loses_nonpositive_w() const { return false; }

  // True if vertices whose position is NaN or exceeds the range of float may be lost.
  virtual bool loses_vertices_beyond_float() const { return false; }

  // True if the capture is used only for attributes that no other capture shows, because it is slow and has
  // the weakest control.
  virtual bool is_last_resort() const { return false; }

  // True if the capture can observe cases that draw these kinds of primitives.
  virtual bool takes(PrimitiveKinds) const { return true; }

  // Runs the case and returns its output with at least the wanted attributes. Throws NotObservable, and all
  // exceptions of gl::play.
  virtual Observation observe(Implementation& implementation, const gl::Case& script,
                              const CaptureRequest& request) const = 0;
};

// Returns new captures in order of preference: sink, transform feedback, feedback buffer, pixels.
std::vector<std::unique_ptr<Capture>> all_captures();

// Chooses among the captures of an implementation. Each capture is proved when it is first considered,
// because a proof runs many cases and most tests need only one capture.
class Captures {
 public:
  // `names`: names of the captures that may be used; null: all. `implementation` and `info` must
  // outlive the object.
  Captures(Implementation& implementation, const ImplementationInfo& info,
           const std::vector<std::string>* names = nullptr);
  Captures(Implementation& implementation, const ImplementationInfo& info,
           std::vector<std::unique_ptr<Capture>> captures);

  std::size_t size() const { return captures_.size(); }
  // Returns the first capture that shows all of these attributes exactly. If `nonpositive_w`, captures that
  // lose vertices with w <= 0 are excluded. Throws NotObservable.
  const Capture& showing_all(Attributes required, PrimitiveKinds kinds, bool nonpositive_w = false);
  // Returns the largest subset of the required attributes that one capture shows exactly. Throws
  // NotObservable if no capture shows any.
  Attributes shown_exactly(Attributes required, PrimitiveKinds kinds);
  // Returns the capture that shows most of the required attributes, followed by up to `most` - 1 others that
  // show at least the same attributes. `nonpositive_w` as above. Throws NotObservable if no capture shows
  // any.
  std::vector<const Capture*> showing_most(Attributes required, PrimitiveKinds kinds, bool nonpositive_w,
                                           std::size_t most);
  // Proves all captures at once, before a case leaves the implementation no memory for a proof.
  void prove_all();

 private:
  struct Entry {
    std::unique_ptr<Capture> capture;
    bool proved = false;
  };
  // Returns the proved capture, or null if it cannot be used; the reason is printed to standard output once.
  const Capture* proved(Entry& entry);

  Implementation& implementation_;
  const ImplementationInfo& info_;
  std::vector<Entry> captures_;
};

std::unique_ptr<Capture> make_sink();
std::unique_ptr<Capture> make_transform_feedback();
std::unique_ptr<Capture> make_feedback_buffer();
std::unique_ptr<Capture> make_pixels();

// A capture's prologue, GetError, the script, and GetError, so that errors of the capture are not taken for
// errors of the script. The capture appends its epilogue to `commands`.
struct WrappedCase {
  gl::Case commands;
  gl::Ref error_before;  // GetError after the prologue
  gl::Ref error_after;   // GetError after the script
};
WrappedCase begin_wrapping(gl::Case prologue, const gl::Case& script);

}  // namespace evalcts
