// Vertices straight out of an evaluator in this process.
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
      if (attributes_ & kNormal) attributes_ |= kUnitNormal;  // no shader in the way
    }
    std::string wrong;
    try {
      wrong = try_control(*this, implementation, {true, true}, attributes_);
    } catch (const gl::MissingEntryPoint&) {
      // An evaluator without explicit vertices: nothing lies between it and us that could change them.
    }
    if (!wrong.empty()) throw NotObservable(wrong);
  }
  Attributes attributes() const override { return attributes_; }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const Wanted& wanted) const override {
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
    observation.units = kTextureUnits;
    observation.primitives = context->take_emitted();
    observation.overflow = observation.vertex_count() > wanted.most_vertices;
    return observation;
  }

 private:
  Attributes attributes_ = 0;
};

}  // namespace

std::unique_ptr<Capture> make_sink() { return std::make_unique<Sink>(); }

}  // namespace evalcts
