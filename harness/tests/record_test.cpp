// Tests `evalcts record` with programs that draw on OSMesa.
#include <elf.h>
#include <sys/mount.h>

#include <algorithm>
#include <cstring>

#include <evalcts/gl/call_log.h>
#include <evalcts/record/recording.h>
#include "program.h"

namespace evalcts {
namespace {

namespace fs = std::filesystem;
using record::Recording;

class Record : public ProgramTest {
 protected:
  // Records the client with these arguments into the file "x".
  Outcome record(const std::vector<std::string>& arguments, const std::vector<std::string>& options = {}) {
    std::vector<std::string> command = {"record", "-o", file_};
    command.insert(command.end(), options.begin(), options.end());
    command.emplace_back(RECORD_CLIENT);
    command.insert(command.end(), arguments.begin(), arguments.end());
    return evalcts(command);
  }

  // Returns the recorded commands of a context.
  static std::vector<gl::Command> commands(const fs::path& file, std::size_t context = 0) {
    std::vector<gl::Command> all;
    Recording(file).read(
        context, [&](gl::Command command) { all.push_back(std::move(command)); }, [] {});
    return all;
  }
  // Returns them as C.
  static std::vector<std::string> calls(const fs::path& file, std::size_t context = 0) {
    std::vector<std::string> all;
    for (const gl::Command& command : commands(file, context)) all.push_back(gl::to_c(command));
    return all;
  }
  static std::size_t times(const std::vector<std::string>& all, const std::string& begin) {
    return static_cast<std::size_t>(
        std::ranges::count_if(all, [&](const std::string& call) { return call.starts_with(begin); }));
  }

  const std::string file_ = (folder_ / "x").string();
};

TEST_F(Record, CommandsBitForBit) {
  const Outcome outcome = record({"draw"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(outcome.text.starts_with("recorded " + file_)) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "1 context\n"));
  EXPECT_TRUE(contains(outcome.text, "13 evaluator commands: glMap1f 4, glEvalCoord1f 2, "));
  EXPECT_TRUE(contains(outcome.text, "2 commands only counted: glLoadIdentity 2\n"));
  const std::vector<std::string> expected = {
      "glMap1f(GL_MAP1_VERTEX_3, 0.0f, 1.0f, 3, 3, "
      "(GLfloat[]){0.0f, 0.0f, 0.0f, 0.5f, 1.0f, 0.1f, 1.0f, 0.0f, -0.0f});",
      "glEnable(GL_MAP1_VERTEX_3);", "glBegin(GL_LINE_STRIP);", "glEvalCoord1f(0.0f);",
      "glEvalCoord1f(0.5f);", "glEnd();",
      "glMap2d(GL_MAP2_INDEX, 0.0, 1.0, 10, 2, -1.0, 1.0, 5, 2, "
      "(GLdouble[]){0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, NAN, 0.0, 0.0, 0.0, 0.0, 3.0});",
      "glMapGrid2f(2, 0.0f, 1.0f, 3, 0.0f, 1.0f);", "glEvalMesh2(GL_FILL, 0, 2, 0, 3);",
      // The rejected commands are not here.
      "glGetError();", "glGetError();",
      // Integer forms are recorded as doubles.
      "glColor4d(-1.0, 1.0, 0.00392156862745098, 0.011764705882352941);", "glColor3d(1.0, 0.0, 0.2);",
      "glNormal3d(1.0, -1.0, 2.3283064370807974e-10);", "glTexCoord2d(-3.0, 4.0);",
      "glMultiTexCoord2d(GL_TEXTURE1, 5.0, 6.0);", "glMultiTexCoord1f(GL_TEXTURE1, 0.25f);",
      "glActiveTexture(GL_TEXTURE0);", "glIndexd(7.0);", "glEdgeFlag(GL_FALSE);", "glGenLists(2);",
      "glNewList(1, GL_COMPILE);", "glBegin(GL_POINTS);", "glEvalCoord1d(0.75);", "glVertex2d(1.0, -1.0);",
      "glEnd();", "glEndList();", "glCallLists(2, 0x1403, (GLubyte[]){1, 0, 0, 0});",
      "glGetMapfv(GL_MAP1_VERTEX_3, GL_COEFF, (GLfloat[16]){0});",
      "glGetMapiv(GL_MAP2_INDEX, GL_ORDER, (GLint[16]){0});", "glGetError();", "glFinish();"};
  EXPECT_EQ(calls(file_), expected);
  // Six commands read arrays that the GL does not read.
  std::map<std::string, std::uint64_t> left_out;
  const Recording recording(file_);
  for (const record::Counted& each : recording.left_out()) left_out[each.name] = each.times;
  EXPECT_EQ(left_out,
            (std::map<std::string, std::uint64_t>{{"glMap1f", 3}, {"glMap1d", 1}, {"glCallLists", 2}}));
  // The gaps between the points are not recorded, and a NaN keeps its payload.
  for (const gl::Command& command : commands(file_)) {
    if (command.entry != gl::EntryPoint::Map2d) continue;
    const auto& points = std::get<gl::Input>(command.arguments.back());
    std::vector<std::uint64_t> bits(points.bytes.size() / 8), wanted(16);
    std::memcpy(bits.data(), points.bytes.data(), 8 * bits.size());
    wanted[5] = 0x3FF0000000000000;
    wanted[10] = 0x7FF8000000001234;
    wanted[15] = 0x4008000000000000;
    EXPECT_EQ(bits, wanted);
  }
}

TEST_F(Record, CommandsThatAProgramLooksUp) {
  const Outcome outcome = evalcts({"record", "-o", file_, RECORD_LOADED});
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_FALSE(contains(outcome.text, "exit status"));
  EXPECT_EQ(Recording(file_).contexts(), 2u);
  for (const std::size_t context : {0, 1})
    EXPECT_EQ(
        calls(file_, context),
        (std::vector<std::string>{"glMap1f(GL_MAP1_INDEX, 0.0f, 1.0f, 1, 2, (GLfloat[]){0.25f, 0.75f});",
                                  "glEvalCoord1f(0.5f);", "glFinish();", "glFinish();"}));
}

TEST_F(Record, LibrariesFindWhatIsBehindThem) {
  const Outcome outcome = record({"nothing"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_FALSE(contains(outcome.text, "exit status"));
}

TEST_F(Record, ProgramsThatEndEarly) {
  const Outcome aborted = record({"abort", "300000"});
  EXPECT_EQ(aborted.code, 0) << aborted.text;
  EXPECT_TRUE(contains(aborted.text, "evalcts: the program ended by signal 6 (Aborted)\n"));
  EXPECT_EQ(times(calls(file_), "glEvalCoord1f"), 300000u);
  const Outcome ended = record({"exit", "3"});
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_TRUE(contains(ended.text, "evalcts: the program ended with exit status 9\n"));
  EXPECT_EQ(times(calls(file_), "glEvalCoord1f"), 3u);
  EXPECT_LT(fs::file_size(file_), 100000u);  // cut behind the last record
}

TEST_F(Record, SignalsArePassedOn) {
  const Outcome outcome = evalcts({"record", "-o", file_, "sh", "-c", "kill -TERM $PPID; sleep 60"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(contains(outcome.text, "the program ended by signal 15"));
}

TEST_F(Record, ProcessesHaveFilesOfTheirOwn) {
  const Outcome outcome = record({"fork"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(times(calls(file_), "glEvalCoord1f"), 5u);
  EXPECT_EQ(times(calls(file_ + ".2"), "glEvalCoord1f"), 3u);
  // A process without evaluators needs no file, and files of the same name are overwritten.
  const std::string client = RECORD_CLIENT;
  const Outcome script =
      evalcts({"record", "-o", file_, "sh", "-c", client + " other; " + client + " points 2"});
  EXPECT_EQ(script.code, 0) << script.text;
  EXPECT_EQ(times(calls(file_), "glEvalCoord1f"), 2u);
  EXPECT_FALSE(fs::exists(file_ + ".2"));
}

TEST_F(Record, ContextsOfThreads) {
  const Outcome outcome = record({"threads"});
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  ASSERT_EQ(Recording(file_).contexts(), 2u);
  std::set<std::string> commands_of_last;
  for (const std::size_t context : {0, 1}) {
    const std::vector<std::string> all = calls(file_, context);
    ASSERT_EQ(all.size(), 100002u);
    EXPECT_TRUE(contains(all[0], "glMap1f("));
    const std::string number = all[2].substr(0, all[2].find(','));
    std::size_t differences = 0;
    for (std::size_t k = 0; k < 100000; ++k)
      differences += all[k + 2] != number + ", 0.0f, " + std::to_string(k % 1000) + ".0f);";
    EXPECT_EQ(differences, 0u);
    commands_of_last.insert(all.back());
  }
  EXPECT_EQ(commands_of_last.size(), 2u);
}

TEST_F(Record, ProgramsThatCloseAllDescriptors) {
  const Outcome outcome = record({"descriptors", "300000"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(times(calls(file_), "glEvalCoord1f"), 300000u);
}

TEST_F(Record, LimitsOfTheSize) {
  const auto expect_cut = [&](const Outcome& outcome, const std::string& why) {
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(contains(outcome.text, "evalcts record: "));
    EXPECT_TRUE(contains(outcome.text, why + "; the recording ends here\n"));
    EXPECT_TRUE(contains(outcome.text, "1 context\n"));
    EXPECT_FALSE(contains(outcome.text, "the program ended"));
    EXPECT_FALSE(Recording(file_).problem().empty());
    const std::size_t points = times(calls(file_), "glEvalCoord1f");
    EXPECT_GT(points, 100000u);
    EXPECT_LT(points, 300000u);
    EXPECT_LE(fs::file_size(file_), std::uintmax_t{1} << 20);
  };
  expect_cut(record({"points", "300000"}, {"--limit", "1"}),
             "the size limit is reached (--limit or ulimit -f)");
  const std::string command =
      std::string(EVALCTS_PROGRAM) + " record -o " + file_ + " " + RECORD_CLIENT + " points 300000";
  expect_cut(start({"/bin/bash", "-c", "ulimit -f 1024; " + command}),
             "the size limit is reached (--limit or ulimit -f)");
}

TEST_F(Record, FullDisk) {
  const fs::path disk = folder_ / "disk";
  fs::create_directory(disk);
  if (geteuid() != 0 || mount("none", disk.c_str(), "tmpfs", 0, "size=1152k") != 0)
    GTEST_SKIP() << "no file system can be mounted here";
  const Outcome outcome = evalcts({"record", "-o", disk / "x", RECORD_CLIENT, "points", "300000"});
  const std::size_t points = times(calls(disk / "x"), "glEvalCoord1f");
  umount2(disk.c_str(), MNT_DETACH);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "No space left on device; the recording ends here\n"));
  EXPECT_FALSE(contains(outcome.text, "the program ended"));
  EXPECT_GT(points, 100000u);
}

TEST_F(Record, ChosenFrames) {
  const Outcome outcome = record({"frames", "5"}, {"--frames", "1..2"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(contains(outcome.text, "6 frames, 1 context"));
  const std::vector<std::string> all = calls(file_);
  EXPECT_EQ(times(all, "glMap1f"), 5u);
  EXPECT_EQ(times(all, "glColor3f"), 5u);
  for (const char* const drawing : {"glBegin", "glEvalCoord1f", "glEnd", "glFinish"})
    EXPECT_EQ(times(all, drawing), 2u) << drawing;
  EXPECT_EQ(record({"frames", "5"}, {"--frames", "2..1"}).code, 2);
}

TEST_F(Record, NothingToRecord) {
  const Outcome other = record({"other"});
  EXPECT_EQ(other.code, 2);
  EXPECT_TRUE(contains(other.text,
                       "called no evaluator command, so there is no recording; it called glLoadIdentity 7,"));
  EXPECT_FALSE(fs::exists(file_));
  const Outcome nothing = record({"nothing"});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_TRUE(contains(nothing.text, "called no command of an OpenGL with evaluators"));

  const fs::path copy = folder_ / "copy";
  fs::copy_file(RECORD_CLIENT, copy);
  fs::permissions(copy, fs::perms::set_uid, fs::perm_options::add);
  EXPECT_TRUE(contains(evalcts({"record", "-o", file_, copy, "nothing"}).text, "is setuid or setgid"));
  fs::permissions(copy, fs::perms::set_uid, fs::perm_options::remove);
  // A program without a dynamic linker is statically linked.
  std::string program = read_file(copy);
  Elf64_Ehdr header;
  std::memcpy(&header, program.data(), sizeof header);
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    const Elf64_Word none = PT_NULL;
    Elf64_Phdr segment;
    std::memcpy(&segment, &program[header.e_phoff + i * header.e_phentsize], sizeof segment);
    if (segment.p_type == PT_INTERP)
      std::memcpy(&program[header.e_phoff + i * header.e_phentsize], &none, sizeof none);
  }
  std::ofstream(copy) << program;
  EXPECT_TRUE(contains(evalcts({"record", "-o", file_, copy}).text, "is statically linked"));
  EXPECT_TRUE(contains(evalcts({"record", "-o", file_, "./absent"}).text, "cannot start './absent'"));
  EXPECT_TRUE(contains(evalcts({"record", "-o", folder_, copy}).text, "not a regular file"));
}

}  // namespace
}  // namespace evalcts
