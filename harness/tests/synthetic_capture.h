// A capture without a library, for tests of the test kit: it shows the vertices of the executable
// specification, changed by a function of the test.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <evalcts/capture/capture.h>
#include <evalcts/judge/prediction.h>

namespace evalcts {

// An implementation that cannot create contexts.
class WithoutContexts final : public Implementation {
 public:
  std::string name() const override { return "without contexts"; }
  std::unique_ptr<Context> create_context() override { throw std::logic_error("a context was asked for"); }
};

struct CaptureTraits {
  std::string name = "Synthetic";
  Attributes attributes = kPosition;
  Attributes inexact_attributes = 0;
  bool available = true;
  bool loses_nonpositive_w = false;
  bool is_last_resort = false;
  PrimitiveKinds takes = kPoints | kLines | kPolygons;
};

class SyntheticCapture final : public Capture {
 public:
  using Change = std::function<void(Observation&, const gl::Case&)>;

  explicit SyntheticCapture(CaptureTraits traits, Change change = {})
      : traits_(std::move(traits)), change_(std::move(change)) {}

  std::string name() const override { return traits_.name; }
  void prove(Implementation&, const ImplementationInfo&) override {
    ++proofs;
    if (!traits_.available) throw NotObservable("not in this test");
  }
  Attributes attributes() const override { return traits_.attributes; }
  Attributes inexact_attributes() const override { return traits_.inexact_attributes; }
  bool loses_nonpositive_w() const override { return traits_.loses_nonpositive_w; }
  bool is_last_resort() const override { return traits_.is_last_resort; }
  bool takes(PrimitiveKinds kinds) const override { return (kinds & ~traits_.takes) == 0; }

  // Does not split primitives.
  Observation observe(Implementation& implementation, const gl::Case& script,
                      const CaptureRequest& request) const override {
    ++observations;
    last_implementation = &implementation;
    last_request = request;
    Observation observation;
    observation.attributes = shown();
    for (const reference::Primitive& predicted : predict(script, 8).primitives) {
      ObservedPrimitive& primitive = observation.primitives.emplace_back();
      primitive.mode = predicted.mode;
      for (const reference::Vertex& vertex : predicted.vertices) {
        ObservedVertex& seen = primitive.vertices.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) {
          seen.position[i] = reference::rounded(vertex.position[i]);
          seen.color[i] = reference::rounded(vertex.color[i]);
          seen.texture_coordinate[0][i] = reference::rounded(vertex.texture_coordinate[0][i]);
        }
      }
    }
    if (change_) change_(observation, script);
    return observation;
  }

  int proofs = 0;
  mutable int observations = 0;
  mutable CaptureRequest last_request;
  mutable const Implementation* last_implementation = nullptr;

 private:
  CaptureTraits traits_;
  Change change_;
};

}  // namespace evalcts
