// SPDX-License-Identifier: BSD-3-Clause
// Paper, Fig. 3: how far the depth of a flat board errs, against its distance.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "programs/options.h"
#include "sources/recorded_sequence.h"
#include "sources/simulated_sources.h"
#include "sources/variants.h"
#include "tables/csv_writer.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kBorder = 12;  // [px] half a matching window and what its edge effects reach beyond it
constexpr double kWhite = 0.8, kDark = 0.05;

struct DepthError {
  double distance = 0;   ///< [m] of the board along the optical axis
  double deviation = 0;  ///< [m] standard deviation from the best-fit plane (paper, III-A)
  double bias = 0;       ///< [m] mean distance from the true plane, positive away from the camera
  double valid = 0;      ///< share of the board's pixels with depth
};

/// The pixels that see the board, without its border and without what the right camera cannot see.
cv::Mat1b boardMask(const Rectangle& board, const StereoCamera& camera) {
  cv::Mat1b mask(camera.height, camera.width, std::uint8_t{0});
  std::vector<cv::Point> outline;
  for (const Eigen::Vector3d& corner : board.corners()) {
    const Eigen::Vector2d pixel = camera.project(corner);
    outline.emplace_back(std::lround(pixel.x()), std::lround(pixel.y()));
  }
  cv::fillConvexPoly(mask, outline, 255);
  const std::optional<DisparityPlane> disparity = toDisparityPlane(board.plane(), camera);
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if (u < disparity.value().at(u, v)) mask(v, u) = 0;
  const int side = 2 * kBorder + 1;
  cv::erode(mask, mask, cv::Mat::ones(side, side, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  return mask;
}

DepthError measure(const DepthFrame& frame, const Rectangle& board) {
  const cv::Mat1b mask = boardMask(board, frame.camera);
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < mask.rows; ++v)
    for (int u = 0; u < mask.cols; ++u)
      if (mask(v, u) && isValidDisparity(frame.disparity(v, u)))
        points.push_back(frame.camera.point(u, v, frame.disparity(v, u)));
  DepthError error;
  error.distance = board.center().z();
  error.valid = static_cast<double>(points.size()) / std::max(1, cv::countNonZero(mask));
  error.deviation = error.bias = std::nan("");
  if (points.size() < 3) return error;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) center += p / points.size();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) scatter += (p - center) * (p - center).transpose() / points.size();
  error.deviation = std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues()[0]));
  error.bias = -board.plane().distance(center);
  return error;
}

void evaluate(FrameSource& source, CsvWriter* csv) {
  BlockMatcher matcher({});
  for (int i = 0; i < source.size(); ++i) {
    const Frame frame = source.frame(i);
    const DepthError error = measure(depthFrame(frame, source.camera(), &matcher), frame.fronts.at(0).rectangle);
    csv->row(source.name(), error.distance, 1e3 * error.deviation, 1e3 * error.bias, error.valid);
  }
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"distances", "11"}, {"sequences", ""}});
  CsvWriter csv(options.out("fig03.csv"), "source,distance_m,deviation_mm,bias_mm,valid_share");
  const int count = options.count("distances");
  std::vector<double> distances;
  for (int i = 0; i < count; ++i) distances.push_back(count == 1 ? 1 : 0.5 + 2.5 * i / (count - 1));
  evaluate(*simulateBoard("simulated_board_white", kWhite, distances), &csv);
  evaluate(*simulateBoard("simulated_board_dark", kDark, distances), &csv);
  for (const std::string& folder : findSequences(options.text("sequences"), true)) evaluate(*openRecordedSequence(folder), &csv);
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::runProgram("fig03_depth_error", "",
                                          [&] { return cabinet_articulation::core::evaluation::run(argc, argv); });
}
