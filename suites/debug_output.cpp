// Section 22 of the requirements, debug output: messages of a debug context about errors of evaluator
// commands.
#include <fmt/format.h>

#include <algorithm>

#include <evalcts/gl/contexts.h>
#include <evalcts/testkit/registration.h>
#include "maps.h"
#include "rejection.h"

namespace evalcts::suite_debug_output {
namespace {

constexpr std::size_t kMessages = 8;  // messages that one call fetches

std::vector<NamedCalls> mistakes() {
  const std::vector<float> points(12, 0.5f);
  return {{"Map1f of order 0", [=](gl::Case& c) { c.Map1f(GL_MAP1_VERTEX_3, 0, 1, 3, 0, points); }},
          {"Map1d of an empty domain",
           [=](gl::Case& c) { c.Map1d(GL_MAP1_VERTEX_3, 1, 1, 3, 2, std::vector<double>(6, 0.5)); }},
          {"Map2f with a small stride",
           [=](gl::Case& c) { c.Map2f(GL_MAP2_VERTEX_3, 0, 1, 2, 2, 0, 1, 3, 2, points); }},
          {"MapGrid1f of 0 segments", [](gl::Case& c) { c.MapGrid1f(0, 0, 1); }},
          {"MapGrid2f of 0 segments", [](gl::Case& c) { c.MapGrid2f(1, 0, 1, 0, 0, 1); }},
          {"EvalMesh1 of FILL", [](gl::Case& c) { c.EvalMesh1(GL_FILL, 0, 1); }},
          {"EvalMesh2 of TRIANGLES", [](gl::Case& c) { c.EvalMesh2(GL_TRIANGLES, 0, 1, 0, 1); }},
          {"GetMapfv of a texture",
           [](gl::Case& c) { c.GetMapfv(GL_TEXTURE_2D, GL_ORDER, gl::out<GLfloat>(4)); }}};
}

// The error of a command, and the sources and types of the messages about it.
struct Answer {
  GLenum error;
  std::vector<GLuint> sources, types;
  gl::Ref asked;

  bool is_reported() const {
    for (std::size_t i = 0; i < std::min(sources.size(), types.size()); ++i)
      if (sources[i] == GL_DEBUG_SOURCE_API && types[i] == GL_DEBUG_TYPE_ERROR) return true;
    return false;
  }
};
struct Answers {
  CheckedTrace checked;
  std::vector<Answer> all;
};

// Runs the commands in a debug context, each of them twice, because a command of a case writes one array: the
// sources are fetched after the first call and the types after the second one.
Answers answers(Test& t, const gl::Identity& identity, const std::vector<NamedCalls>& commands) {
  struct Fetched {
    gl::Ref error, count, array;
  };
  gl::Case c(identity);
  c.ContextOfKindEVALCTS(1, EVALCTS_DEBUG);
  for (int i = 0; i < 2; ++i)  // discards messages about the context itself
    c.GetDebugMessageLog(64, 0, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  std::vector<Fetched> fetched;
  for (const NamedCalls& command : commands)
    for (const bool types : {false, true}) {
      command.issue(c);
      const gl::Ref error = c.GetError();
      const auto room = gl::out<GLuint>(kMessages);
      const gl::Ref log =
          types ? c.GetDebugMessageLog(kMessages, 0, nullptr, room, nullptr, nullptr, nullptr, nullptr)
                : c.GetDebugMessageLog(kMessages, 0, room, nullptr, nullptr, nullptr, nullptr, nullptr);
      fetched.push_back({error, log, log});
    }
  Answers answers = {t.play(c), {}};
  const gl::Trace& trace = answers.checked.trace();
  const auto messages = [&](const Fetched& of) {
    std::vector<GLuint> values = trace.values<GLuint>(of.array);
    values.resize(std::min<std::size_t>(static_cast<std::size_t>(trace.result(of.count)), kMessages));
    return values;
  };
  for (std::size_t i = 0; i < fetched.size(); i += 2)
    answers.all.push_back({trace.error(fetched[i].error), messages(fetched[i]), messages(fetched[i + 1]),
                           fetched[i + 1].count});
  return answers;
}

// Errors of evaluator commands are reported if the error of another command is.
EVALCTS_TEST(Pipeline, DebugMessages, kQuality, "EV-PIPE-DEBUG")
(Test& t) {
  t.require(4, 3, "GL_KHR_debug");
  const Answers control =
      answers(t, gl::control("Enable"), {{"Enable of nothing", [](gl::Case& c) { c.Enable(GL_POINTS); }}});
  if (control.all[0].error != GL_INVALID_ENUM || !control.all[0].is_reported())
    throw NotObservable("pipeline: the debug context has no message for the error of another command");
  const std::vector<NamedCalls> commands = existing_calls(t, mistakes());
  Answers evaluators = answers(t, "errors of evaluators", commands);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const Answer& answer = evaluators.all[i];
    if (answer.error == GL_NO_ERROR) continue;  // other tests judge missing errors
    evaluators.checked.expect(
        answer.is_reported(), answer.asked,
        fmt::format("{}: no message of type DEBUG_TYPE_ERROR from DEBUG_SOURCE_API", commands[i].name),
        "a message", fmt::format("{} other messages", answer.types.size()));
  }
};

}  // namespace
}  // namespace evalcts::suite_debug_output
