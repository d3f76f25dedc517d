// Tests the limits of the log of a child process, and that messages of evalcts are kept.
#include <evalcts/runner/output_log.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include <evalcts/results/files.h>

namespace evalcts {
namespace {

class OutputLogTest : public testing::Test {
 protected:
  ~OutputLogTest() override { std::filesystem::remove(path_); }

  void print(OutputLog& log, const std::string& text) {
    for (std::size_t done = 0; done < text.size(); done += 4096) {
      const std::string piece = text.substr(done, 4096);
      ASSERT_EQ(write(log.writer(), piece.data(), piece.size()), static_cast<ssize_t>(piece.size()));
      log.take();
    }
  }
  std::string content() const { return read_file(path_); }

  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) / ("output-log-" + std::to_string(getpid()) + ".txt");
};

std::string lines(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "0123456789abcde\n";
  return text;
}

TEST_F(OutputLogTest, KeepsTheBeginningOfWhatEachTestPrints) {
  const std::string first = "[ RUN      ] A.B\n", second = "[ RUN      ] A.C\n",
                    most = lines(kMostPrinted / 16 - 2);
  {
    OutputLog log(path_);
    print(log, "before\n" + first + most + lines(1000) + second + most + "no end of line");
    log.close_writer();
    log.finish();
    EXPECT_LT(log.reader(), 0);
  }
  const std::size_t more = std::filesystem::file_size(path_);
  EXPECT_LT(more, 2 * kMostPrinted + 200);
  const std::string text = content(), left_out = "evalcts: 16000 more bytes are omitted here\n";
  EXPECT_TRUE(text.starts_with("before\n" + first + most)) << text.substr(0, 100);
  const std::size_t at = text.find(left_out);
  ASSERT_NE(at, std::string::npos) << text.substr(text.size() - 200);
  EXPECT_EQ(text.substr(at + left_out.size()), second + most + "no end of line");
}

TEST_F(OutputLogTest, ATestBeginsBehindWhatALibraryPrintedWithoutAnEnd) {
  OutputLog log(path_);
  print(log, lines(kMostPrinted / 8) + "half a line[ RUN      ] A.B\nshort\n");
  log.finish();
  EXPECT_TRUE(content().ends_with("half a line[ RUN      ] A.B\nshort\n"));
}

TEST_F(OutputLogTest, SaysWhereItCannotWrite) { EXPECT_THROW(OutputLog("/nonexistent/log"), CannotWrite); }

}  // namespace
}  // namespace evalcts
