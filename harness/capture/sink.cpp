// Vertices straight out of an evaluator in this process.
#include "harness/capture/control.h"

namespace evalcts {
namespace {

class Sink final : public Capture {
 public:
  std::string name() const override { return "Sink"; }

  void prove(Implementation& implementation, const ImplementationInfo&) override {
    if (!implementation.create_context()->has_sink())
      throw NotObservable("not an evaluator inside this process");
    const std::string wrong = try_control(*this, implementation, {true, true}, kAllAttributes);
    if (!wrong.empty()) throw NotObservable(wrong);
  }
  Attributes attributes() const override { return kAllAttributes; }

  Observation observe(Implementation& implementation, const gl::Case& script,
                      const Wanted& wanted) const override {
    const std::unique_ptr<Context> context = implementation.create_context();
    const WrappedCase wrapped = begin_wrapping({}, script);
    Observation observation;
    const gl::Trace trace = context->play(wrapped.commands);
    observation.error = trace.error(wrapped.error_after);
    observation.attributes = kAllAttributes;
    observation.units = kTextureUnits;
    observation.primitives = context->take_emitted();
    observation.overflow = observation.vertex_count() > wanted.most_vertices;
    return observation;
  }
};

}  // namespace

std::unique_ptr<Capture> make_sink() { return std::make_unique<Sink>(); }

}  // namespace evalcts
