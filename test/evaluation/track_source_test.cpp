// SPDX-License-Identifier: BSD-3-Clause
#include "sources/track_source.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "sources/simulated_sources.h"
#include "stereo/whole_millimetres.h"
#include "tables/failure_picture.h"

namespace cabinet_articulation::core::evaluation {
namespace {
namespace fs = std::filesystem;

TEST(TrackSource, FramesShowTheFrontThatMoves) {
  SimulationConfig config;
  config.scene = "drawer";
  config.rate = 5;
  const auto frames = simulateRun(config);
  const auto source = trackFrames(*frames);
  EXPECT_EQ(source->facts().type, JointType::kPrismatic);
  ASSERT_EQ(static_cast<int>(source->reference().size()), frames->size());
  std::vector<int> all(frames->size());
  std::iota(all.begin(), all.end(), 0);
  Track track;
  std::optional<LearnedModel> model;
  source->observe(all, [&](const SeenFront& front) {
    track = front.track;
    if (front.model) model = *front.model;
  });
  ASSERT_GE(track.observations.size(), 10U);  // the drawer is open in some 20 of the frames
  const TrackedObservation& seen = track.observations[track.observations.size() / 2];
  const int index = static_cast<int>(std::lround(seen.stamp * config.rate));
  EXPECT_LT((seen.rectangle.center() - source->reference()[index].rectangle.center()).norm(), 0.015);
  ASSERT_TRUE(model) << "the pipeline learns on the way";
  EXPECT_EQ(model->id, track.id);
  EXPECT_EQ(model->type, JointType::kPrismatic);
}

/// A simulated run as a depth camera would deliver it.
class DepthOnly : public FrameSource {
 public:
  explicit DepthOnly(std::unique_ptr<FrameSource> run) : run_(std::move(run)) {}

  const std::string& name() const override { return run_->name(); }
  const StereoCamera& camera() const override { return run_->camera(); }
  int size() const override { return run_->size(); }
  bool independent() const override { return run_->independent(); }
  Frame frame(int index) override {
    Frame frame = run_->frame(index);
    const cv::Mat1w depth = wholeMillimetres(matcher_.process(frame.left, frame.right, camera()));
    frame.releaseImages();
    frame.depth = depth;
    return frame;
  }

 private:
  std::unique_ptr<FrameSource> run_;
  BlockMatcher matcher_{StereoConfig()};
};

TEST(TrackSource, ADepthImageTakesThePlaceOfThePair) {
  SimulationConfig config;
  config.scene = "drawer";
  config.rate = 5;
  DepthOnly frames(simulateRun(config));
  const auto source = trackFrames(frames);
  std::vector<int> all(frames.size());
  std::iota(all.begin(), all.end(), 0);
  std::size_t observed = 0;
  source->observe(all, [&](const SeenFront& front) { observed = front.track.observations.size(); });
  EXPECT_GE(observed, 10U);
}

TEST(TrackSource, OfADepthImageWhatWasMissedIsDrawnToo) {
  Frame frame;
  frame.depth = cv::Mat1w(48, 64, std::uint16_t{1000});
  frame.depth(5, 60) = 2000;
  const cv::Mat3b drawn = drawFailure(frame, StereoCamera(), {}, {}, {});
  EXPECT_EQ(drawn.size(), cv::Size(128, 96));
  EXPECT_EQ(drawn(90, 10), cv::Vec3b(128, 128, 128));
}

TEST(TrackSource, ALogIsItsOwnReference) {
  const std::string path = (fs::temp_directory_path() / ("track_source_test_" + std::to_string(getpid()))).string();
  std::ofstream(path) << "0 0 1\n0 0 1.1\n0 0 1.3\n";
  const auto source = openPoseLog(path, "log", "prismatic");
  EXPECT_EQ(source->facts().name, "log");
  EXPECT_FALSE(source->facts().has_orientation);
  EXPECT_NEAR(source->reference().at(2).opened, 0.3, 1e-12);
  std::vector<std::size_t> lengths;
  source->observe({0, 2}, [&](const SeenFront& front) {
    lengths.push_back(front.track.observations.size());
    EXPECT_EQ(front.model, nullptr) << "nobody learned from a log before";
  });
  EXPECT_EQ(lengths, (std::vector<std::size_t>{1, 2}));
  EXPECT_FALSE(openPoseLog(path, "log", "other")->facts().explainable);
  EXPECT_THROW(openPoseLog(path, "log", "helical"), std::runtime_error);
  fs::remove(path);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
