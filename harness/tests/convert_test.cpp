// Tests `evalcts convert`.
#include <reference/specification.h>
#include <snappy-c.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>

#include <evalcts/gl/call_log.h>
#include <evalcts/gl/case_json.h>
#include <evalcts/judge/prediction.h>
#include <evalcts/record/programs.h>
#include <evalcts/record/recording.h>
#include "apitrace.h"
#include "program.h"
#include "wavefront.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;
using record::Recording;

// The bytes of a trace, written by the description of its format.
class TraceText {
 public:
  explicit TraceText(std::uint64_t version = 6) {
    number(version);
    if (version < 6) return;
    number(version);
    for (const char* const each : {"process.name", "viewer", ""}) text(each);
  }

  TraceText& byte(int value) {
    bytes_ += static_cast<char>(value);
    return *this;
  }
  TraceText& number(std::uint64_t value) {
    for (; value > 0x7F; value >>= 7) byte(static_cast<int>(value & 0x7F) | 0x80);
    return byte(static_cast<int>(value));
  }
  TraceText& text(const std::string& value) {
    number(value.size());
    bytes_ += value;
    return *this;
  }
  TraceText& integer(std::int64_t value) {
    return byte(value < 0 ? 3 : 4).number(static_cast<std::uint64_t>(std::abs(value)));
  }
  TraceText& real(float value) {
    byte(5);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  TraceText& reals(const std::vector<float>& values) {
    byte(11).number(values.size());
    for (const float value : values) real(value);
    return *this;
  }

  // Begins a call; its arguments have to follow, each as argument(i) and a value, then end(), and leave().
  TraceText& enter(const std::string& name, int thread = 0) {
    byte(0).number(static_cast<std::uint64_t>(thread));
    const auto [signature, is_new] = signatures_.try_emplace(name, signatures_.size());
    number(signature->second);
    if (is_new) text(name).number(0);
    return *this;
  }
  TraceText& argument(int index) { return byte(1).number(static_cast<std::uint64_t>(index)); }
  TraceText& end() { return byte(0); }
  TraceText& leave(std::uint64_t call) { return byte(1).number(call).byte(0); }
  // A whole call with integers.
  TraceText& call(const std::string& name, const std::vector<std::int64_t>& arguments, int thread = 0) {
    enter(name, thread);
    for (std::size_t i = 0; i < arguments.size(); ++i) argument(static_cast<int>(i)).integer(arguments[i]);
    return end().leave(calls_++);
  }
  TraceText& curve() {
    enter("glMap1f");
    argument(0).integer(GL_MAP1_VERTEX_3).argument(1).real(0).argument(2).real(1);
    argument(3).integer(3).argument(4).integer(2).argument(5).reals({0, 0, 0, 1.0f / 3, 2, -0.0f});
    return end().leave(calls_++);
  }

  // Returns the file: blocks of at most `most` bytes, each of which is compressed.
  std::string file(std::size_t most = 1000) const {
    std::string file = "at";
    for (std::size_t begin = 0; begin < bytes_.size(); begin += most) {
      const std::string block = bytes_.substr(begin, most);
      std::string compressed(snappy_max_compressed_length(block.size()), '\0');
      std::size_t size = compressed.size();
      snappy_compress(block.data(), block.size(), compressed.data(), &size);
      for (int i = 0; i < 4; ++i) file += static_cast<char>(size >> 8 * i);
      file += compressed.substr(0, size);
    }
    return file;
  }

 private:
  std::string bytes_;
  std::map<std::string, std::uint64_t> signatures_;
  std::uint64_t calls_ = 0;
};

class Convert : public ProgramTest {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    std::ofstream(file, std::ios::binary) << text;
  }
  // Writes a trace and returns the calls of a context of its recording as C.
  std::vector<std::string> calls_of(const std::string& trace, std::size_t context = 0) {
    write(trace_, trace);
    const lab::ImportedTrace imported = lab::import_trace(trace_);
    problem_ = imported.problem;
    write(recording_, imported.recording.text());
    const Recording recording(recording_);
    std::vector<std::string> calls;
    if (context < recording.contexts())
      recording.read(
          context, [&](const gl::Command& command) { calls.push_back(gl::to_c(command)); },
          [&] { calls.push_back("frame"); });
    return calls;
  }
  Outcome shell(const std::string& line) { return start({"/bin/sh", "-c", line}); }

  const std::string trace_ = (folder_ / "x.trace").string(), recording_ = (folder_ / "x.evalrec").string();
  std::string problem_;
};

using Calls = std::vector<std::string>;

TEST_F(Convert, CallsOfATrace) {
  TraceText trace;
  trace.call("glXMakeCurrent", {1, 2, 77}).curve();
  trace.call("glEnable", {GL_MAP1_VERTEX_3}).call("glBegin", {GL_POINTS});
  trace.call("glColor3ub", {255, 0, 51}).call("glVertex3i", {1, -2, 3}).call("glEnd", {});
  trace.call("glMultiTexCoord2sARB", {GL_TEXTURE1, 3, -4}).call("glNormal3b", {-128, 127, 0});
  trace.call("glLightf", {1, 2, 3}).call("glXSwapBuffers", {1, 2}).call("glFlush", {});
  EXPECT_EQ(calls_of(trace.file()),
            (Calls{"glMap1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 2, (GLfloat[]){0.0f, 0.0f, 0.0f, 0.33333334f, "
                   "2.0f, -0.0f});",
                   "glEnable(GL_MAP1_VERTEX_3);", "glBegin(GL_POINTS);", "glColor3d(1.0, 0.0, 0.2);",
                   "glVertex3d(1.0, -2.0, 3.0);", "glEnd();", "glMultiTexCoord2d(GL_TEXTURE1, 3.0, -4.0);",
                   "glNormal3d(-1.0, 1.0, 0.00392156862745098);", "frame", "glFlush();"}));
  EXPECT_EQ(problem_, "");
  const Recording recording(recording_);
  EXPECT_EQ(recording.program(), Calls{"viewer"});
  ASSERT_EQ(recording.others().size(), 1u);
  EXPECT_EQ(recording.others()[0].name, "glLightf");
  // Versions 4 and 5 have no header, and the size of blocks does not matter.
  EXPECT_EQ(calls_of(TraceText(4).call("eglMakeCurrent", {1, 2, 2, 7}).call("glFinish", {}).file(1)),
            (Calls{"glFinish();", "frame"}));
}

TEST_F(Convert, ContextsAndThreadsOfATrace) {
  TraceText trace;
  trace.call("wglMakeCurrent", {1, 7}, 0).call("eglMakeCurrent", {1, 2, 2, 8}, 1);
  trace.call("glEvalPoint1", {1}, 0).call("glEvalPoint1", {2}, 1).call("glEvalPoint1", {3}, 0);
  trace.call("wglDeleteContext", {7}).call("wglMakeCurrent", {1, 7}, 0).call("glEvalPoint1", {4}, 0);
  trace.call("wglMakeCurrent", {1, 0}, 0).call("glEvalPoint1", {5}, 0);
  const std::string file = trace.file();
  EXPECT_EQ(calls_of(file, 0), (Calls{"glEvalPoint1(1);", "glEvalPoint1(3);"}));
  EXPECT_EQ(calls_of(file, 1), (Calls{"glEvalPoint1(2);"}));
  EXPECT_EQ(calls_of(file, 2), (Calls{"glEvalPoint1(4);"}));
  EXPECT_EQ(calls_of(file, 3), Calls{});
  // A trace without the functions of the window system.
  EXPECT_EQ(calls_of(TraceText().call("glEvalPoint1", {6}).file()), Calls{"glEvalPoint1(6);"});
}

TEST_F(Convert, ArraysThatTheTraceLacksAreLeftOut) {
  // A vertex with two of three elements, and one with an address.
  TraceText vertices;
  vertices.call("glXMakeCurrent", {1, 2, 77}).enter("glVertex3fv").argument(0).reals({1, 2}).end().leave(1);
  vertices.enter("glVertex3fv").argument(0).byte(13).number(4096).end().leave(2);
  vertices.enter("glVertex3fv").argument(0).reals({1, 2, 3}).end().leave(3);
  EXPECT_EQ(calls_of(vertices.file()), Calls{"glVertex3fv((GLfloat[]){1.0f, 2.0f, 3.0f});"});
  EXPECT_EQ(Recording(recording_).left_out()[0].times, 2u);
  // Two of three arguments.
  EXPECT_EQ(calls_of(TraceText().call("glVertex3i", {1, 2}).call("glFinish", {}).file()),
            (Calls{"glFinish();", "frame"}));
  EXPECT_EQ(Recording(recording_).others()[0].name, "glVertex3i");

  TraceText trace;
  trace.call("glXMakeCurrent", {1, 2, 77}).enter("glMap1f");
  trace.argument(0).integer(GL_MAP1_VERTEX_3).argument(1).real(0).argument(2).real(1);
  trace.argument(3).integer(3).argument(4).integer(2).argument(5).reals({0, 0, 0, 1, 2});  // one is missing
  trace.end().leave(1);
  calls_of(trace.file());
  ASSERT_EQ(Recording(recording_).left_out().size(), 1u);
  EXPECT_EQ(Recording(recording_).left_out()[0].name, "glMap1f");
}

TEST_F(Convert, DamagedTraces) {
  TraceText trace;
  trace.call("glXMakeCurrent", {1, 2, 77}).curve();
  const std::string file = trace.file(40);
  ASSERT_EQ(calls_of(file).size(), 1u);
  for (std::size_t size = 0; size < file.size(); ++size) {
    try {
      EXPECT_LE(calls_of(file.substr(0, size)).size(), 1u);
      EXPECT_FALSE(problem_.empty()) << size;
    } catch (const lab::BadTrace&) {
      EXPECT_LT(size, 60u);  // within the header
    }
    for (const char bits : {'\x01', '\x80', '\xFF'}) {
      std::string damaged = file;
      damaged[size] = static_cast<char>(damaged[size] ^ bits);
      try {
        calls_of(damaged);
        record::programs_of(Recording(recording_), {});
      } catch (const lab::BadTrace&) {
      }
    }
  }
  // A call without an end, and calls that do not return.
  TraceText endless;
  endless.enter("glFlush");
  for (int i = 0; i < 100000; ++i) endless.argument(63).byte(0);
  EXPECT_EQ(calls_of(endless.file(1 << 20)), Calls{});
  TraceText pending;
  for (int i = 0; i < 100000; ++i) pending.enter("glFlush").end();
  calls_of(pending.file(1 << 20));
  EXPECT_TRUE(contains(problem_, "is damaged"));
  trace.enter("glFlush");
  calls_of(trace.file());
  EXPECT_TRUE(contains(problem_, "ends within a call"));
  write(trace_, TraceText(7).file());
  const Outcome newer = evalcts({"convert", trace_, "-o", recording_});
  EXPECT_EQ(newer.code, 2);
  EXPECT_TRUE(contains(newer.text, "is a trace of format 7, and this evalcts reads formats 4 to 6"));
}

TEST_F(Convert, WrongUse) {
  write(trace_, TraceText().call("glXMakeCurrent", {1, 2, 77}).call("glFlush", {}).file());
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& message) {
    std::vector<std::string> command = {"convert"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Outcome outcome = evalcts(command);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, message)) << outcome.text;
  };
  expect({trace_, "-o", "x.png"}, "the name must end in .evalrec, .json, .c or .obj");
  expect({trace_, "-o", folder_ / "x.obj"}, "has no evaluator commands");
  expect({trace_, "-o", recording_, "--frames", "1"}, "give it to check");
  expect({RECORDED_GLU, "-o", folder_ / "x.obj"}, "convert reads recordings");
  expect({folder_ / "absent", "-o", folder_ / "x.obj"}, "cannot be read");
  write(trace_, TraceText().call("glXMakeCurrent", {1, 2, 77}).curve().file());
  expect({trace_, "-o", folder_ / "no" / "x.evalrec"}, "x.evalrec");
  EXPECT_EQ(evalcts({"convert", trace_, "-o", recording_}).code, 0);
  const std::string kept = read_file(recording_);
  write(trace_, TraceText().call("glXMakeCurrent", {1, 2, 77}).call("glFlush", {}).file());
  expect({trace_, "-o", recording_}, "has no evaluator commands");
  EXPECT_EQ(read_file(recording_), kept);
  expect({recording_, "-o", recording_}, "is not a trace of apitrace");
  expect({recording_, "-o", folder_ / "x.obj", "--frames", "5"}, "no evaluator command is executed");
}

// A trace and a recording of a program have the same bits. The programs are converted, and what comes out is
// used.
TEST_F(Convert, ATraceAgreesWithARecording) {
  const Outcome recorded = evalcts({"record", "-o", recording_, CONVERT_CLIENT});
  if (contains(recorded.text, "exit status 77")) GTEST_SKIP() << "no EGL context";
  ASSERT_EQ(recorded.code, 0) << recorded.text;
  const Outcome traced = shell("apitrace trace -a egl -o " + trace_ + " " + CONVERT_CLIENT);
  if (traced.code == 127) GTEST_SKIP() << "apitrace is not installed";
  ASSERT_EQ(traced.code, 0) << traced.text;
  const std::string imported = folder_ / "imported.evalrec";
  const Outcome converted = evalcts({"convert", trace_, "-o", imported});
  ASSERT_EQ(converted.code, 0) << converted.text;
  EXPECT_TRUE(contains(converted.text, "2 frames, 1 context\n")) << converted.text;
  EXPECT_TRUE(contains(converted.text, "commands only counted: ")) << converted.text;
  const auto programs = record::programs_of(Recording(recording_), {});
  const auto same = record::programs_of(Recording(imported), {});
  ASSERT_EQ(programs.size(), 2u);
  ASSERT_EQ(same.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(programs[i].commands, same[i].commands);

  const fs::path vectors = folder_ / "x.json", c = folder_ / "x.c", meshes = folder_ / "x.obj";
  const Outcome as_vectors = evalcts({"convert", imported, "-o", vectors});
  EXPECT_TRUE(contains(as_vectors.text, "cases: 2 of 2; shortened: 0\n")) << as_vectors.text;
  EXPECT_EQ(evalcts({"vectors", "lint", vectors}).code, 0);
  const Outcome checked = shell("python3 " VECTORS_CHECK " " + vectors.string());
  EXPECT_EQ(checked.code, 0) << checked.text;

  EXPECT_EQ(evalcts({"convert", imported, "-o", c, "--frames", "1"}).code, 0);
  const fs::path program = folder_ / "program";
  const Outcome built = shell("cc -o " + program.string() + " " + c.string() + " -lEGL -lGL");
  EXPECT_EQ(built.code, 0) << built.text;
  EXPECT_EQ(start({program}).code, 0);
  // The same program with an error.
  EXPECT_EQ(shell("sed -i 's/^static void draw.*/& glEnable(0);/' " + c.string() + " && cc -o " +
                  program.string() + " " + c.string() + " -lEGL -lGL")
                .code,
            0);
  EXPECT_EQ(start({program}).code, 1);
  EXPECT_EQ(evalcts({"convert", imported, "-o", c}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "x-Frame0-1.c") && fs::exists(folder_ / "x-Frame1-1.c"));

  const Outcome as_meshes = evalcts({"convert", imported, "-o", meshes, "--frames", "0"});
  EXPECT_TRUE(contains(as_meshes.text, "objects: 1, vertices: ")) << as_meshes.text;
  EXPECT_TRUE(text_of("x.obj").starts_with("o Frame0-1\nv ")) << text_of("x.obj").substr(0, 200);
}

std::string wavefront_of(const gl::Case& script) {
  return lab::wavefront({{"x", predict(script, 8).primitives}});
}

TEST(Wavefront, PositionsAreExactQuotients) {
  gl::Case c;
  c.Map1f(GL_MAP1_VERTEX_4, 0.0f, 1.0f, 4, 2, std::vector<float>{1, 2, 3, 3, 1, 0, 0, 0});
  c.Enable(GL_MAP1_VERTEX_4);
  c.MapGrid1f(1, 0.0f, 1.0f);
  c.EvalMesh1(GL_POINT, 0, 0);
  EXPECT_EQ(wavefront_of(c), "o x\nv 0.3333333333333333 0.6666666666666666 1\np 1\n");
  c.EvalMesh1(GL_LINE, 0, 1);
  EXPECT_TRUE(wavefront_of(c).ends_with("# Left out, because they have no finite position: 1 primitive\n"));
}

TEST(Wavefront, PrimitivesKeepTheirOrientation) {
  const auto elements = [](GLenum mode, int count) {
    gl::Case c;
    c.Begin(mode);
    for (int i = 0; i < count; ++i) c.Vertex3f(static_cast<float>(i), 0.0f, 0.0f);
    c.End();
    std::string text = wavefront_of(c);
    return text.substr(std::min(text.size(), text.find_first_of("plf", 4)));
  };
  EXPECT_EQ(elements(GL_POINTS, 2), "p 1\np 2\n");
  EXPECT_EQ(elements(GL_LINES, 5), "l 1 2\nl 3 4\n");
  EXPECT_EQ(elements(GL_LINE_STRIP, 3), "l 1 2\nl 2 3\n");
  EXPECT_EQ(elements(GL_LINE_LOOP, 3), "l 1 2\nl 2 3\nl 3 1\n");
  EXPECT_EQ(elements(GL_TRIANGLES, 6), "f 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(elements(GL_TRIANGLE_STRIP, 4), "f 1 2 3\nf 3 2 4\n");
  EXPECT_EQ(elements(GL_TRIANGLE_FAN, 4), "f 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(elements(GL_QUADS, 4), "f 1 2 3 4\n");
  EXPECT_EQ(elements(GL_QUAD_STRIP, 6), "f 1 2 4 3\nf 3 4 6 5\n");
  EXPECT_EQ(elements(GL_POLYGON, 5), "f 1 2 3 4 5\n");
}

TEST(Wavefront, AttributesThatAreSet) {
  gl::Case c;
  c.Normal3f(0.0f, 1.0f, 0.0f);
  c.TexCoord2f(0.5f, 0.25f);
  c.Color3f(1.0f, 0.5f, 0.0f);
  c.Begin(GL_TRIANGLES);
  for (int i = 0; i < 3; ++i) c.Vertex2f(static_cast<float>(i), 2.0f);
  c.End();
  c.Begin(GL_LINES);
  for (int i = 0; i < 2; ++i) c.Vertex2f(static_cast<float>(i), 2.0f);
  c.End();
  const std::string text = wavefront_of(c);
  EXPECT_TRUE(text.starts_with("o x\nv 0 2 0 1 0.5 0\nvt 0.5 0.25\nvn 0 1 0\n")) << text;
  EXPECT_TRUE(contains(text, "f 1/1/1 2/2/2 3/3/3\n")) << text;
  EXPECT_TRUE(contains(text, "l 4/4 5/5\n")) << text;
  // Coordinates that are not finite are left out.
  gl::Case infinite;
  infinite.TexCoord4f(1.0f, 1.0f, 0.0f, 0.0f);
  infinite.append(c);
  infinite.Begin(GL_POINTS);
  infinite.TexCoord4f(1.0f, 1.0f, 0.0f, 0.0f);
  infinite.Vertex2f(0.0f, 0.0f);
  infinite.End();
  EXPECT_FALSE(contains(wavefront_of(infinite), "vt "));
}

}  // namespace
}  // namespace evalcts
