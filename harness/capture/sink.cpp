// Captures vertices directly from an evaluator in this process.
#include <optional>

#include "control.h"

namespace evalcts {
namespace {

class Sink final : public Capture {
 public:
  std::string name() const override { return "Sink"; }

  void prove(Implementation& implementation, const ImplementationInfo&) override {
    {
      const std::unique_ptr<Context> context = implementation.create_context();
      if (!context->has_sink()) throw NotObservable("not an evaluator inside this process");
      attributes_ = context->emitted_attributes();
      if (attributes_ & kNormal) attributes_ |= kUnitNormal;  // no vertex shader is involved
    }
    std::string wrong;
    try {
      wrong = try_control(*this, implementation, {true, true}, attributes_);
    } catch (const gl::MissingEntryPoint&) {
      // The evaluator has no explicit vertices. There is no pipeline that could change the emitted ones.
    }
    if (!wrong.empty()) keep_what_is_confirmed(implementation, wrong);
  }
  Attributes attributes() const override { return attributes_ & ~inexact_attributes(); }
  Attributes inexact_attributes() const override { return color_error_ ? kColor : 0u; }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const CaptureRequest& request) const override {
    const std::unique_ptr<Context> context = implementation.create_context();
    Observation observation;
    if (gl::has(context->table(), gl::EntryPoint::GetError)) {
      const WrappedCase wrapped = begin_wrapping({}, script);
      observation.error = context->play(wrapped.commands).error(wrapped.error_after);
    } else {
      context->play(script);
      observation.error_observed = false;
    }
    observation.attributes = attributes_;
    observation.clamped_colors = clamps_;
    observation.color_error = color_error_.value_or(0);
    observation.units = kTextureUnits;
    observation.primitives = context->take_emitted();
    observation.overflow = observation.vertex_count() > request.most_vertices;
    return observation;
  }

 private:
  void keep_what_is_confirmed(Implementation& implementation, const std::string& wrong) {
    const Attributes offered = attributes_;
    Attributes confirmed = confirm_attributes(*this, implementation, {true, true}, offered);
    if ((offered & kColor) && !(confirmed & kColor)) {
      clamps_ = true;
      confirmed |= confirm_attributes(*this, implementation, {.negative_w = true}, kColor);
      if (!(confirmed & kColor)) color_error_ = measure_color_error(*this, implementation);
      if (color_error_) confirmed |= kColor;
    }
    if (confirmed == 0) throw NotObservable(wrong);
    if (confirmed & kNormal) confirmed |= kUnitNormal;
    // The control uses only texture unit 0; other units are assumed to behave alike.
    if (confirmed & kTextureCoordinate0) confirmed |= offered & kTextureCoordinatesOther;
    attributes_ = confirmed;
  }

  Attributes attributes_ = 0;
  bool clamps_ = false;
  std::optional<double> color_error_;  // set if colours are inexact
};

}  // namespace

std::unique_ptr<Capture> make_sink() { return std::make_unique<Sink>(); }

}  // namespace evalcts
