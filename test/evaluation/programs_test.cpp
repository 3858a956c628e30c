// SPDX-License-Identifier: BSD-3-Clause
// Each program in the smallest setting that still shows something.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {
namespace fs = std::filesystem;

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line + ",");
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Every row must have as many cells as the header.
std::vector<Row> readTable(const fs::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line);
    EXPECT_EQ(cells.size(), header.size()) << path << ": " << line;
    Row row;
    for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) row[header[i]] = cells[i];
    rows.push_back(row);
  }
  return rows;
}

std::string readText(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All programs run once and write to one folder.
class ProgramsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    fs::create_directories(folder());
    std::ofstream(folder() / "labels.csv") << "file,type\ndrawer.txt,prismatic\n";
    std::ofstream log(folder() / "drawer.txt");
    for (int i = 0; i < 100; ++i) log << 0.1 + 0.004 * i << " " << 0.002 * (i * 7 % 5) << " 1.5\n";
    log.close();
    ASSERT_EQ(run("fig03_depth_error", "--distances 1"), 0);
    ASSERT_EQ(run("fig11_detection", "--poses 8 --scenes 0 --failures " + (folder() / "failures").string()), 0);
    ASSERT_EQ(run("kinds_prediction", "--tracks " + folder().string()), 0);
    ASSERT_EQ(run("fig12_models", "--runs 2 --scenes 0 --fronts 5 --tracks " + folder().string()), 0);
    ASSERT_EQ(run("learner_answers", "--tracks " + folder().string()), 0);
    for (const std::string script : {"/plot.py ", "/summarize.py "})
      ASSERT_EQ(std::system(("/usr/bin/python3 " SCRIPTS + script + folder().string() + " >/dev/null").c_str()), 0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder()); }

  static fs::path folder() { return fs::temp_directory_path() / ("evaluation_programs_test_" + std::to_string(getpid())); }

  static int summarize(const fs::path& page) {
    const std::string script = "/usr/bin/python3 " SCRIPTS "/summarize.py ";
    return std::system((script + folder().string() + " " + page.string() + " >/dev/null 2>&1").c_str());
  }

  static int run(const std::string& program, const std::string& arguments) {
    return std::system((std::string(PROGRAMS) + "/" + program + " " + arguments + " " + folder().string()).c_str());
  }
};

TEST_F(ProgramsTest, DepthError) {
  const std::vector<Row> rows = readTable(folder() / "fig03.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("source"), "simulated_board_white");
  EXPECT_EQ(rows[0].at("distance_m"), "1");
  // The paper: 2 mm up to over 1 m.
  EXPECT_GT(std::stod(rows[0].at("deviation_mm")), 0.1);
  EXPECT_LT(std::stod(rows[0].at("deviation_mm")), 2);
  EXPECT_GT(std::stod(rows[0].at("valid_share")), 0.99);
}

TEST_F(ProgramsTest, Detection) {
  EXPECT_EQ(readTable(folder() / "fig11_frames.csv").size(), 24U);  // ours, ours from depth, and the paper's
  const std::vector<Row> fronts = readTable(folder() / "fig11_fronts.csv");
  ASSERT_EQ(fronts.size(), 3U);
  EXPECT_EQ(fronts[0].at("variant"), "ours");
  EXPECT_EQ(fronts[1].at("variant"), "ours_depth");
  EXPECT_EQ(fronts[2].at("variant"), "paper");
  EXPECT_EQ(fronts[0].at("judged"), "8");
  // Some of the eight hang 3 m away.
  EXPECT_GE(std::stod(fronts[0].at("rate")), 0.5);
  EXPECT_GE(std::stod(fronts[1].at("rate")), 0.3);
  EXPECT_GE(std::stod(fronts[2].at("rate")), 0.3);
  int judged = 0;
  for (const Row& row : readTable(folder() / "fig11.csv")) judged += std::stoi(row.at("judged"));
  EXPECT_EQ(judged, 24);
}

/// The only log has no other to learn from.
TEST_F(ProgramsTest, Kinds) {
  const std::vector<Row> logs = readTable(folder() / "kinds.csv"), sets = readTable(folder() / "kinds_sets.csv");
  ASSERT_EQ(logs.size(), 1U);
  EXPECT_EQ(logs[0].at("set"), "prismatic");
  EXPECT_EQ(logs[0].at("set_mm"), logs[0].at("alone_mm"));
  ASSERT_EQ(sets.size(), 1U);
  EXPECT_EQ(sets[0].at("logs"), "1");
}

TEST_F(ProgramsTest, Models) {
  const std::vector<Row> curve = readTable(folder() / "fig12.csv");
  ASSERT_FALSE(curve.empty());
  EXPECT_EQ(curve.back().at("source"), "drawer.txt");
  EXPECT_EQ(curve.back().at("observations"), "80");
  EXPECT_EQ(curve.back().at("right_share"), "1");
  EXPECT_LT(std::stod(curve.back().at("error_mm_mean")), 5);  // the log wobbles by 8 mm
  EXPECT_EQ(readTable(folder() / "fig12_unseen.csv").size(), 2U);
  EXPECT_EQ(readTable(folder() / "fig12_intervals.csv").size(), 7U);
}

TEST_F(ProgramsTest, AnswersAreComparedValueByValue) {
  std::string text = readText(folder() / "answers.csv");
  const auto write = [&](const char* name) {
    std::ofstream(folder() / name) << text;
    return (folder() / name).string();
  };
  const auto same = [&](const std::string& changed) {
    const std::string before = (folder() / "answers.csv").string();
    return std::system(("/usr/bin/python3 " SCRIPTS "/compare_answers.py " + before + " " + changed + " >/dev/null").c_str()) ==
           0;
  };
  EXPECT_TRUE(same(write("same.csv")));
  // After all 100 poses the front is a drawer.
  const std::string type = "drawer.txt,after100,type,1\n";
  const std::size_t at = text.find(type);
  ASSERT_NE(at, std::string::npos);
  text[at + type.size() - 2] = '2';
  EXPECT_FALSE(same(write("other_type.csv")));
  text.erase(at, type.size());
  EXPECT_FALSE(same(write("without_type.csv")));
}

TEST_F(ProgramsTest, AnswersAreCountedByWhatTheySay) {
  const std::string script = "/usr/bin/python3 " SCRIPTS "/reliability.py --list ", answers = (folder() / "answers.csv").string();
  const std::string counts = (folder() / "counts.txt").string(), wrong = (folder() / "wrong.csv").string();
  ASSERT_EQ(std::system((script + answers + " >" + counts).c_str()), 0);
  EXPECT_NE(readText(counts).find("last answers: 1 of 1 right"), std::string::npos) << readText(counts);
  std::ofstream(wrong) << std::regex_replace(readText(answers), std::regex(",truth,1\n"), ",truth,2\n");
  ASSERT_EQ(std::system((script + answers + " " + wrong + " >" + counts).c_str()), 0);
  EXPECT_NE(readText(counts).find("last answers: 1 of 2 right"), std::string::npos) << readText(counts);
  EXPECT_NE(readText(counts).find("drawer.txt: prismatic with"), std::string::npos) << readText(counts);
  const std::string old = (folder() / "old.csv").string();
  std::ofstream(old) << std::regex_replace(readText(answers), std::regex("[^\n]*,observed,[^\n]*\n"), "");
  EXPECT_NE(std::system((script + old + " 2>" + counts).c_str()), 0);
  EXPECT_EQ(readText(counts).find("reliability.py: " + old + " has no field \"observed\""), 0U) << readText(counts);
}

TEST_F(ProgramsTest, Figures) {
  for (const char* name : {"fig03.png", "fig11_simulated_hanging_drawer.png", "fig12.png", "fig12_unseen.png"}) {
    ASSERT_TRUE(fs::exists(folder() / name)) << name;
    EXPECT_GT(fs::file_size(folder() / name), 10000U) << name;  // an empty plot is smaller
  }
}

TEST_F(ProgramsTest, Summary) {
  const std::string text = readText(folder() / "summary.md");
  EXPECT_NE(text.find("| drawer.txt | prismatic | "), std::string::npos) << text;
  EXPECT_NE(text.find("| simulated_hanging_drawer | drawer | ours | 8 | "), std::string::npos) << text;
}

TEST_F(ProgramsTest, TheTablesGoIntoThePageAndNothingElseChanges) {
  const fs::path page = folder() / "evaluation.md";
  fs::copy_file(SCRIPTS "/../doc/evaluation.md", page, fs::copy_options::overwrite_existing);
  const std::string before = readText(page), begin = "<!-- Tables: ", end = "<!-- End of the tables. -->\n";
  ASSERT_EQ(summarize(page), 0);
  const std::string after = readText(page), summary = readText(folder() / "summary.md");
  EXPECT_EQ(after.substr(0, after.find(begin)), before.substr(0, before.find(begin)));
  EXPECT_EQ(after.substr(after.find(end)), before.substr(before.find(end)));
  EXPECT_NE(after.find("-->\n\n" + summary + "\n" + end), std::string::npos) << after;
  ASSERT_EQ(summarize(page), 0);
  EXPECT_EQ(readText(page), after) << "twice is once";
  std::ofstream(page) << "a page without marks\n";
  EXPECT_NE(summarize(page), 0);
  EXPECT_EQ(readText(page), "a page without marks\n");
}

TEST_F(ProgramsTest, RefuseWhatTheyDoNotKnow) {
  EXPECT_NE(run("fig03_depth_error", "--nonsense 1 2>/dev/null"), 0);
  EXPECT_NE(run("fig11_detection", "--poses many 2>/dev/null"), 0);
  EXPECT_NE(run("fig12_models", "--tracks /no/such/folder --scenes 0 2>/dev/null"), 0);
}

}  // namespace
