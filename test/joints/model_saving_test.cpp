// SPDX-License-Identifier: BSD-3-Clause
// What a save does to the file that is there.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "cabinet_articulation/joints/model_file.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"
#include "joints/removed_fronts.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using test::learned;
using test::ThrowsSaying;
using testing::AllOf;
using testing::HasSubstr;

class ModelSaving : public test::ModelFolder {
 protected:
  static KnownFront door() { return learned(test::doorModel()); }
  static KnownFront drawer() { return learned(test::drawerModel()); }

  /// A door of its own place for every i.
  static KnownFront doorNumber(int i) {
    KnownFront front = learned(test::moved(test::doorModel(), Eigen::Vector3d(2.0 * i, 0, 0)));
    test::setId(static_cast<std::uint32_t>(i + 1), &front);
    return front;
  }

  std::vector<std::uint32_t> idsIn(const fs::path& path) const {
    std::vector<std::uint32_t> ids;
    for (const KnownFront& front : readModelFile(path).fronts) ids.push_back(front.model.id);
    return ids;
  }
};

TEST_F(ModelSaving, MergesAndLeavesNothingBehind) {
  saveModelFile(path_, {"map", {door(), drawer()}});
  KnownFront garage = learned(test::garageModel());
  test::setId(4, &garage);
  const SavedModels saved = saveModelFile(path_, {"map", {garage}});
  EXPECT_EQ(saved.inWords(path_),
            "3 fronts saved to '" + path_ + "', 2 of them as the file had them; front 4 of the file is front 5 now");
  EXPECT_THAT(idsIn(path_), testing::ElementsAre(3, 4, 5));
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(ModelSaving, GivesIdsThatAFileCanHold) {
  KnownFront last = door();
  test::setId(4294967295U, &last);
  EXPECT_THAT(saveModelFile(path_, {"map", {last, drawer()}}).inWords(path_), HasSubstr("; front 4294967295 is front 5 there"));
  EXPECT_THAT(idsIn(path_), testing::ElementsAre(4, 5));
}

TEST_F(ModelSaving, OfNothingKeepsWhatIsThere) {
  saveModelFile(path_, {"map", {door(), drawer()}});
  const std::string before = text();
  EXPECT_EQ(saveModelFile(path_, {"map", {}}).fronts, 2u);
  EXPECT_EQ(saveModelFile(path_, {"", {}}).fronts, 2u) << "before the first frame";
  EXPECT_EQ(saveModelFile(path_, {"odom", {}}).fronts, 2u) << "in another frame";
  EXPECT_EQ(text(), before);
}

TEST_F(ModelSaving, KeepsADamagedFileBesideTheNewOne) {
  saveModelFile(path_, {"map", {door(), drawer()}});
  const std::string half = text().substr(0, text().size() / 2);
  for (int i = 1; i <= 2; ++i) {
    write(half);
    const std::string kept = path_ + ".kept-" + std::to_string(i);
    EXPECT_THAT(saveModelFile(path_, {"map", {door()}}).inWords(path_),
                AllOf(HasSubstr("1 fronts saved"), HasSubstr("cannot be merged"), HasSubstr("is kept as '" + kept + "'")));
    EXPECT_EQ(textOf(kept), half);
    EXPECT_THAT(idsIn(path_), testing::ElementsAre(3));
  }
  EXPECT_EQ(filesInFolder(), 3);
}

TEST_F(ModelSaving, KeepsAFileOfAnotherFrameOrVersionBesideTheNewOne) {
  saveModelFile(path_, {"map", {door()}});
  EXPECT_THAT(saveModelFile(path_, {"odom", {drawer()}}).kept,
              HasSubstr("its poses are in the frame 'map', and the new ones in 'odom'"));
  EXPECT_THAT(idsIn(path_ + ".kept-1"), testing::ElementsAre(3));
  EXPECT_EQ(readModelFile(path_).frame, "odom");
  damage("version: 1", "version: 3");
  EXPECT_THAT(saveModelFile(path_, {"odom", {door()}}).kept, HasSubstr("its version is 3"));
  EXPECT_THAT(textOf(path_ + ".kept-2"), HasSubstr("version: 3"));
}

TEST_F(ModelSaving, NeverTouchesWhatIsNoModelFile) {
  for (const std::string notes : {"just some text\n", "", "a: [1, 2"}) {
    write(notes);
    EXPECT_THAT(
        [&] {
          saveModelFile(path_, {"map", {door()}});
        },
        ThrowsSaying<ModelFileError>(HasSubstr("it is left as it is, and nothing is saved")));
    EXPECT_EQ(text(), notes);
    EXPECT_EQ(filesInFolder(), 1);
  }
}

TEST_F(ModelSaving, FollowsLinksAndLeavesThemLinks) {
  fs::create_directory(folder_ / "disk");
  const fs::path target = folder_ / "disk" / "models.yaml";
  fs::create_symlink("disk/models.yaml", path_);
  saveModelFile(path_, {"map", {door()}});
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_THAT(idsIn(target), testing::ElementsAre(3)) << "a link to nowhere gets its target";
  saveModelFile(path_, {"map", {drawer()}});
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_THAT(idsIn(target), testing::ElementsAre(3, 4));
  const fs::path loop = folder_ / "loop";
  fs::create_symlink("loop", loop);
  EXPECT_THAT(
      [&] {
        saveModelFile(loop, {"map", {door()}});
      },
      ThrowsSaying<ModelFileError>(HasSubstr("a link that leads nowhere")));
}

TEST_F(ModelSaving, WritesThroughNoLinkBesideTheFile) {
  const fs::path precious = folder_ / "precious.txt";
  std::ofstream(precious) << "precious";
  fs::create_symlink(precious, path_ + ".new");
  saveModelFile(path_, {"map", {door()}});
  EXPECT_EQ(textOf(precious), "precious");
  EXPECT_FALSE(fs::is_symlink(path_));
}

TEST_F(ModelSaving, KeepsTheModeOfTheFile) {
  saveModelFile(path_, {"map", {door()}});
  ASSERT_EQ(::chmod(path_.c_str(), 0640), 0);
  saveModelFile(path_, {"map", {drawer()}});
  EXPECT_EQ(static_cast<int>(fs::status(path_).permissions()), 0640);
}

TEST_F(ModelSaving, ClearsAwayWhatADeadSaverLeftAndNothingElse) {
  std::ofstream(folder_ / ".kitchen.yaml.saving-0123abcd") << "half";
  std::ofstream(folder_ / ".kitchen.yaml.saving-notes.txt") << "mine";
  saveModelFile(path_, {"map", {door()}});
  EXPECT_FALSE(fs::exists(folder_ / ".kitchen.yaml.saving-0123abcd"));
  EXPECT_TRUE(fs::exists(folder_ / ".kitchen.yaml.saving-notes.txt"));
}

TEST_F(ModelSaving, OfSeveralThreadsAndProcessesAtOnceLosesNothing) {
  constexpr int kProcesses = 4, kThreads = 2, kSaves = 3;
  std::vector<pid_t> children;
  for (int process = 0; process < kProcesses; ++process) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child != 0) {
      children.push_back(child);
      continue;
    }
    std::atomic<int> failed{0};
    std::vector<std::thread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kSaves; ++i) try {
            saveModelFile(path_, {"map", {doorNumber((process * kThreads + thread) * kSaves + i)}});
          } catch (const ModelFileError&) {
            ++failed;
          }
      });
    for (std::thread& thread : threads) thread.join();
    ::_exit(failed);
  }
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << WEXITSTATUS(status) << " saves failed";
  }
  EXPECT_EQ(readModelFile(path_).fronts.size(), static_cast<size_t>(kProcesses * kThreads * kSaves));
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(ModelSaving, ASaverThatDiedHoldsUpNobody) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const int folder = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY);
    ::flock(folder, LOCK_EX);
    ::raise(SIGKILL);
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_EQ(saveModelFile(path_, {"map", {door()}}).fronts, 1u);
}

TEST_F(ModelSaving, TakesOneFrontFromTheFile) {
  EXPECT_EQ(removeFromModelFile(path_, "map", {test::doorModel()}), 0u) << "there is no file";
  KnownFront renamed = door();
  test::setId(17, &renamed);
  saveModelFile(path_, {"map", {drawer(), renamed}});
  EXPECT_EQ(removeFromModelFile(path_, "odom", {test::doorModel()}), 0u) << "another frame, another place";
  EXPECT_EQ(removeFromModelFile(path_, "map", {test::doorModel()}), 1u);
  EXPECT_THAT(idsIn(path_), testing::ElementsAre(4));
}

TEST_F(ModelSaving, WhatWasRemovedStaysAwayUntilItIsLearnedAgain) {
  saveModelFile(path_, {"map", {door(), drawer()}});
  RemovedFronts removed;
  removed.add(test::doorModel());
  const auto save = [&](const std::vector<KnownFront>& fronts) {
    saveModelFile(path_, {"map", fronts}, removed.in(path_));
    removed.saved(path_, fronts);
  };
  save({drawer()});
  EXPECT_THAT(idsIn(path_), testing::ElementsAre(4));
  KnownFront again = door();
  test::setId(9, &again);
  save({drawer(), again});
  save({drawer()});
  EXPECT_THAT(idsIn(path_), testing::ElementsAre(4, 9)) << "what was learned since is not what was removed";
  EXPECT_EQ(removed.in(folder_ / "other.yaml").size(), 1u) << "another file may still hold the old one";
  EXPECT_TRUE(removed.in((folder_ / "." / "kitchen.yaml").string()).empty()) << "the same file by another name";
  removed.loaded({again});
  EXPECT_TRUE(removed.empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
