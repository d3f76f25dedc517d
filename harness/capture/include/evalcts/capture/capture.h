// Captures: ways to see what an evaluator emitted. A capture wraps a case in commands of its own, plays it in
// a fresh context (once for each pass that it needs) and decodes what came back.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <evalcts/backends/implementation.h>
#include <evalcts/gl/observation.h>
#include <evalcts/gl/player.h>

namespace evalcts {

// What is asked of a capture.
struct Wanted {
  Attributes attributes = 0;       // to be observed at least
  std::size_t most_vertices = 0;   // as they come out; where more come, Observation::overflow is set
  PrimitiveKinds kinds = kPoints;  // that the case draws
};

class Capture {
 public:
  virtual ~Capture() = default;
  virtual std::string name() const = 0;

  // Proves itself on a control of explicit Vertex, Color, Normal and TexCoord commands, and learns what it
  // can see of this implementation. Throws NotObservable if it cannot be used. To be called once, before
  // observe().
  virtual void prove(Implementation& implementation, const ImplementationInfo& info) = 0;

  // The attributes that it reproduces bit for bit; valid after prove().
  virtual Attributes attributes() const = 0;

  // Further attributes, which it reproduces up to an error that observations state
  // (Observation::color_error); valid after prove().
  virtual Attributes inexact_attributes() const { return 0; }

  // All attributes that observations show, exact or not; valid after prove().
  Attributes shown() const { return attributes() | inexact_attributes(); }

  // Those of the wanted attributes of a vertex that observations show, exact or not. A kind of normals
  // (kUnitNormal, kShaderNormal) that is wanted but not shown leaves no normals.
  Attributes shown_of(Attributes wanted) const;

  // Whether vertices with w <= 0 are lost on the way; valid after prove().
  virtual bool loses_nonpositive_w() const { return false; }

  // Whether vertices whose position is no number, or beyond float, may be lost on the way.
  virtual bool loses_vertices_beyond_float() const { return false; }

  // True if it is used only for what no other capture shows: it is slow, and its control is the weakest.
  virtual bool is_last_resort() const { return false; }

  // Whether it can see a case that draws these kinds of primitives.
  virtual bool takes(PrimitiveKinds) const { return true; }

  // Plays the case and returns what came out, with at least the wanted attributes. Throws NotObservable, and
  // whatever gl::play throws.
  virtual Observation observe(Implementation& implementation, const gl::Case& script,
                              const Wanted& wanted) const = 0;
};

// Sink, TransformFeedback, FeedbackBuffer, Pixels, in order of preference.
std::vector<std::unique_ptr<Capture>> all_captures();

// The captures of an implementation in order of preference, and the choice among them. Each is proved when it
// is first considered: a proof plays many cases, and most tests need one capture only.
class Captures {
 public:
  // `names`: those that may be used; all where it is null. Both references must outlive the object.
  Captures(Implementation& implementation, const ImplementationInfo& info,
           const std::vector<std::string>* names = nullptr);
  Captures(Implementation& implementation, const ImplementationInfo& info,
           std::vector<std::unique_ptr<Capture>> captures);

  std::size_t size() const { return captures_.size(); }
  // The first capture that shows all of these attributes exactly. Throws NotObservable.
  const Capture& showing_all(Attributes required, PrimitiveKinds kinds);
  // The capture that shows most of the required attributes, and up to `most` - 1 more that show at least the
  // same. With `nonpositive_w` only captures that do not lose such vertices. Throws NotObservable.
  std::vector<const Capture*> showing_most(Attributes required, PrimitiveKinds kinds, bool nonpositive_w,
                                           std::size_t most);
  // For an implementation that will soon have no room for a proof.
  void prove_all();

 private:
  struct Entry {
    std::unique_ptr<Capture> capture;
    bool proved = false;
  };
  // Null if it cannot be used, which is written to standard output once.
  const Capture* proved(Entry& entry);

  Implementation& implementation_;
  const ImplementationInfo& info_;
  std::vector<Entry> captures_;
};

std::unique_ptr<Capture> make_sink();
std::unique_ptr<Capture> make_transform_feedback();
std::unique_ptr<Capture> make_feedback_buffer();
std::unique_ptr<Capture> make_pixels();

// A script behind a capture's prologue, with GetError between them and after it: what the capture itself
// raises is not the script's. Epilogues are added to `commands`.
struct WrappedCase {
  gl::Case commands;
  gl::Ref error_before;  // GetError after the prologue
  gl::Ref error_after;   // GetError after the script
};
WrappedCase begin_wrapping(gl::Case prologue, const gl::Case& script);

}  // namespace evalcts
