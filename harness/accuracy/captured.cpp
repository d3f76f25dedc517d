// The subject that measures a GL: it calls glMap, glEnable, glBegin(GL_POINTS), glEvalCoord and glEnd as
// users do, and takes the results from a capture.
#include <memory>
#include <utility>

#include <evalcts/accuracy/subject.h>
#include <evalcts/backends/gl_environment.h>
#include <evalcts/backends/mesa_build.h>
#include <evalcts/capture/observed_values.h>
#include <evalcts/gl/case.h>
#include <evalcts/results/serialization.h>
#include <evalcts/runner/worker.h>

namespace evalcts::accuracy {
namespace {

gl::Case commands_of(GLenum target, const Map& map, std::span<const float> u, std::span<const float> v) {
  gl::Case c;
  const std::vector<float> points(map.points.begin(), map.points.end());
  const bool two_dimensional = !v.empty();
  const auto end = [&](std::size_t i) { return static_cast<GLfloat>(map.domain[i]); };
  if (two_dimensional) {
    c.Map2f(target, end(0), end(1), map.vorder * map.components, map.uorder, end(2), end(3), map.components,
            map.vorder, points);
    if (map.segments > 0) c.MapGrid2f(map.segments, end(0), end(1), map.segments, end(2), end(3));
  } else {
    c.Map1f(target, end(0), end(1), map.components, map.uorder, points);
    if (map.segments > 0) c.MapGrid1f(map.segments, end(0), end(1));
  }
  const auto index = [&](float x, std::size_t i) {
    return grid_index(x, map.domain[i], map.domain[i + 1], map.segments);
  };
  c.Enable(target);
  // Nothing is drawn without an enabled vertex map. The initial map, of order 1, is sufficient.
  if (attribute_of(target) != kPosition) c.Enable(two_dimensional ? GL_MAP2_VERTEX_3 : GL_MAP1_VERTEX_3);
  c.Begin(GL_POINTS);
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (map.segments > 0) {
      if (two_dimensional)
        c.EvalPoint2(index(u[i], 0), index(v[i], 2));
      else
        c.EvalPoint1(index(u[i], 0));
    } else if (two_dimensional) {
      c.EvalCoord2f(u[i], v[i]);
    } else {
      c.EvalCoord1f(u[i]);
    }
  }
  c.End();
  return c;
}

// Observes the results in this process, or in a worker.
class Captured : public Subject {
 public:
  std::string capture() const override { return used_; }
  ImplementationInfo info() const override { return info_; }

  std::vector<float> evaluate(GLenum target, const Map& map, std::span<const float> u,
                              std::span<const float> v) override {
    ObservedValues observed = observe({commands_of(target, map, u, v), attribute_of(target),
                                       static_cast<std::uint64_t>(map.components), u.size()});
    used_ = std::move(observed.capture);
    return std::move(observed.values);
  }

 protected:
  ImplementationInfo info_;

 private:
  virtual ObservedValues observe(const ValuesRequest& request) = 0;

  std::string used_;
};

class Here final : public Captured {
 public:
  explicit Here(const ImplementationOptions& options) : implementation_(open_implementation(options)) {
    info_ = inquire(*implementation_);
    captures_ = std::make_unique<Captures>(*implementation_, info_);
    if (!options.mesa_build.empty()) require_mesa_build(options.mesa_build, loaded_gl_files());
  }

 private:
  ObservedValues observe(const ValuesRequest& request) override {
    return observe_values(*captures_, *implementation_, request);
  }

  std::unique_ptr<Implementation> implementation_;
  std::unique_ptr<Captures> captures_;
};

class Elsewhere final : public Captured {
 public:
  explicit Elsewhere(const ImplementationOptions& options) : command_(options.words()) {
    command_.insert(command_.begin(), "evalcts-suite");
    const auto description = answer<Description>({"describe", "describe"});
    const ImplementationRecord& found = description.implementation;
    info_.name = found.name;
    info_.library = found.library;
    info_.vendor = found.vendor;
    info_.renderer = found.renderer;
    info_.version = found.version;
    info_.max_eval_order = static_cast<GLint>(found.max_eval_order.value_or(0));
  }

 private:
  ObservedValues observe(const ValuesRequest& request) override {
    ValuesObserved observed =
        answer<ValuesObserved>({.kind = "observe", .name = "points", .data = to_text(request)});
    if (!observed.why_not.empty()) throw NotObservable(observed.why_not);
    return {std::move(observed.capture), std::move(observed.values)};
  }

  // Gives the worker a job and returns its answer. Throws CannotStart if there is none; the next job has a
  // worker of its own then.
  template <class Answer>
  Answer answer(const Job& job) {
    if (!worker_) worker_ = std::make_unique<Worker>(command_, "", Limits());
    std::optional<Answer> found;
    worker_->give(job);
    while (!worker_->is_idle()) {
      const bool has_ended = worker_->update({}, [&](const Event& event) {
        if (const auto* answer = std::get_if<Answer>(&event)) found = *answer;
      });
      if (has_ended) break;
      if (!worker_->is_idle()) wait_for_activity({worker_.get()});
    }
    if (found) return std::move(*found);
    const std::string reason = why_no_answer(worker_->run(), "");
    worker_.reset();
    if (info_.name.empty()) throw CannotStart(reason);
    throw NotObservable(reason);
  }

  std::vector<std::string> command_;
  std::unique_ptr<Worker> worker_;
};

}  // namespace

std::unique_ptr<Subject> make_captured(const ImplementationOptions& options) {
  if (options.worker.empty()) return std::make_unique<Here>(options);
  return std::make_unique<Elsewhere>(options);
}

}  // namespace evalcts::accuracy
