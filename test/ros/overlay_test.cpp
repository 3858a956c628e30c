// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/overlay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay_labels.h"
#include "support/models.h"

namespace cabinet_articulation {
namespace {

const core::StereoCamera kCamera{320, 240, 300, 300, 160, 120, 0.08, 0};

cv::Mat3b draw(const std::vector<core::DetectedRectangle>& rectangles, const std::vector<core::LearnedModel>& models) {
  cv::Mat3b image(kCamera.height, kCamera.width, cv::Vec3b(0, 0, 0));
  drawOverlay(kCamera, rectangles, models, &image);
  return image;
}

/// True if something was drawn within a pixel of the image of p.
bool drawnAt(const cv::Mat3b& image, const Eigen::Vector3d& p) {
  const Eigen::Vector2d uv = kCamera.project(p);
  const cv::Rect around(static_cast<int>(uv.x()) - 1, static_cast<int>(uv.y()) - 1, 3, 3);
  return cv::sum(cv::sum(image(around & cv::Rect(0, 0, image.cols, image.rows))))[0] > 0;
}

TEST(Overlay, DrawsTheOutlineOfARectangleWhereTheCameraSeesIt) {
  core::DetectedRectangle detected;
  detected.rectangle = {test::facingCamera(0.05, -0.03, 1.2), 0.4, 0.2};
  const cv::Mat3b image = draw({detected}, {});
  const auto corners = detected.rectangle.corners();
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(drawnAt(image, corners[i])) << i;
    EXPECT_TRUE(drawnAt(image, (corners[i] + corners[(i + 1) % 4]) / 2)) << i;
  }
  EXPECT_FALSE(drawnAt(image, detected.rectangle.center()));
}

TEST(Overlay, DrawsADoorsFrontAxisAndRange) {
  const core::LearnedModel door = test::doorModel();
  const cv::Mat3b image = draw({}, {door});
  for (const Eigen::Vector3d& corner : frontAt(door, door.q).corners()) EXPECT_TRUE(drawnAt(image, corner));
  for (const Eigen::Vector3d& corner : frontAt(door, door.q_max).corners()) EXPECT_TRUE(drawnAt(image, corner));
  const cv::Vec3b hinge = image(cv::Point(static_cast<int>(kCamera.project(door.axis_point).x()), 90));
  EXPECT_GT(hinge[2], hinge[1]) << "the axis is red";
  EXPECT_TRUE(drawnAt(image, door.predict(0.25).translation())) << "the way of the front's centre";
}

TEST(Overlay, DrawsTheWayOfACurve) {
  const core::LearnedModel garage = test::garageModel();
  const cv::Mat3b image = draw({}, {garage});
  for (const double q : {0.05, 0.1, 0.15}) EXPECT_TRUE(drawnAt(image, garage.predict(q).translation())) << q;
}

TEST(Overlay, ColourTellsTheType) {
  EXPECT_NE(colorOf(test::doorModel()), colorOf(test::drawerModel()));
  EXPECT_NE(colorOf(test::garageModel()), colorOf(test::drawerModel()));
  EXPECT_NE(colorOf(test::restingModel()), colorOf(test::doorModel()));
  EXPECT_NE(colorOf(test::unexplainedModel()), colorOf(test::restingModel()));
}

TEST(Overlay, LabelTellsWhatIsKnown) {
  EXPECT_EQ(labelOf(test::drawerModel()), "4 prismatic 99 %, 20 cm (0 to 30)");
  EXPECT_EQ(labelOf(test::restingModel()), "1 no motion yet");
  EXPECT_EQ(labelOf(test::unexplainedModel()), "5 moved, no joint fits");
  core::LearnedModel drawer = test::drawerModel();
  drawer.name = "cutlery";
  EXPECT_EQ(labelOf(drawer), "4 cutlery prismatic 99 %, 20 cm (0 to 30)");
  EXPECT_EQ(shortLabelOf(drawer), "4 cutlery");
  EXPECT_EQ(shortLabelOf(test::restingModel()), "1");
}

/// Pixels of exactly this colour.
int count(const cv::Mat3b& image, const Color& color) {
  const cv::Vec3b bgr(cv::saturate_cast<std::uint8_t>(255 * color[2]), cv::saturate_cast<std::uint8_t>(255 * color[1]),
                      cv::saturate_cast<std::uint8_t>(255 * color[0]));
  cv::Mat1b same;
  cv::inRange(image, bgr, bgr, same);
  return cv::countNonZero(same);
}

TEST(Overlay, GaugesGrowWithProbabilityAndOpening) {
  core::LearnedModel drawer = test::drawerModel();
  const auto gaugePixels = [](const core::LearnedModel& model) {
    cv::Mat3b image(kCamera.height, kCamera.width, cv::Vec3b(0, 0, 0));
    drawLabels({{labelOf(model), {160, 120}, colorOf(model), gaugeOf(model)}}, &image);
    return count(image, colorOf(model));
  };
  const int open = gaugePixels(drawer);
  drawer.q = 0.1;
  const int ajar = gaugePixels(drawer);
  drawer.q = 0;
  drawer.probabilities[1] = 0.5;
  const int doubtful = gaugePixels(drawer);
  EXPECT_LT(ajar, open - 40);
  EXPECT_LT(doubtful, ajar - 40);
  EXPECT_FALSE(gaugeOf(test::restingModel()));
  drawer.q = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(gaugeOf(drawer)->opening, 0);
  // First seen open: q grows as it closes.
  drawer.q = drawer.q_max;
  drawer.closed_known = true;
  drawer.opening = 0;
  EXPECT_EQ(gaugeOf(drawer)->opening, 0);
}

TEST(Overlay, LabelsAreWhiteOnDarkWhateverIsBelow) {
  cv::Mat3b image(kCamera.height, kCamera.width, cv::Vec3b::all(255));
  drawLabels({{"12", {160, 120}, colorOf(test::restingModel()), {}}}, &image);
  EXPECT_LT(image(116, 168)[0], 120) << "the box";
  EXPECT_GT(cv::countNonZero(cv::Mat1b(image.reshape(1) < 100)), 200);
}

TEST(Overlay, TextThatIsTooLongIsCutOff) {
  cv::Mat3b image(kCamera.height, kCamera.width, cv::Vec3b::all(255));
  drawLabels({{std::string(1000000, 'w'), {160, 120}, colorOf(test::restingModel()), {}}}, &image);
  EXPECT_LT(image(116, 20)[0], 120) << "the box is as wide as the image";
  cv::Mat3b tiny(3, 3, cv::Vec3b::all(255));
  drawLabels({{"12", {1, 1}, colorOf(test::restingModel()), {}}}, &tiny);
  EXPECT_EQ(count(tiny, {1, 1, 1}), 9) << "there is no room";
}

TEST(Overlay, ManyFrontsAtOnePlaceAreDrawnWithinTheImage) {
  std::vector<core::LearnedModel> models;
  for (std::uint32_t i = 0; i < 300; ++i) {
    models.push_back(i % 3 == 0 ? test::doorModel() : test::restingModel());
    models.back().id = i + 1;
    models.back().name = std::string(i, 'x');
  }
  EXPECT_EQ(draw({}, models).size(), cv::Size(320, 240));
}

/// How dichromats see it: F. Vienot, H. Brettel, J. Mollon, "Digital video colourmaps for checking the legibility of displays by
/// dichromats", 1999; matrices for linear sRGB.
Eigen::Vector3d seenBy(const Eigen::Matrix3d& vision, const Color& color) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const auto shown = [](double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; };
  const Eigen::Vector3d seen = vision * Eigen::Vector3d(linear(color[0]), linear(color[1]), linear(color[2]));
  return seen.cwiseMax(0).cwiseMin(1).unaryExpr(shown);
}

TEST(ModelDrawing, ColoursAreToldApartWithAnyColourVision) {
  Eigen::Matrix3d protanope, deuteranope;
  protanope << 0.11238, 0.88762, 0, 0.11238, 0.88762, 0, 0.00401, -0.00401, 1;
  deuteranope << 0.29275, 0.70725, 0, 0.29275, 0.70725, 0, -0.02234, 0.02234, 1;
  std::vector<Color> colors{kRectangleColor, kAxisColor, colorOf(test::restingModel()), colorOf(test::unexplainedModel())};
  for (const core::ModelEntry& entry : core::modelRegistry())
    if (entry.moves) colors.push_back(entry.color);
  constexpr double kJustTold = 0.14;  // of 0 to 1 in each channel; the colours that were drawn before came as near as 0.05
  for (const Eigen::Matrix3d& vision : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), protanope, deuteranope})
    for (std::size_t i = 0; i < colors.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT((seenBy(vision, colors[i]) - seenBy(vision, colors[k])).norm(), kJustTold) << i << ' ' << k;
}

TEST(Overlay, CutsOffWhatIsBehindTheCameraOrNotFinite) {
  core::LearnedModel through = test::doorModel();
  through.origin.translation().z() = through.axis_point.z() = 0.05;  // swings through the camera
  core::LearnedModel broken = test::doorModel();
  broken.axis_point.x() = std::numeric_limits<double>::quiet_NaN();
  core::DetectedRectangle behind;
  behind.rectangle = {test::facingCamera(0, 0, -1), 0.4, 0.2};
  EXPECT_EQ(cv::countNonZero(draw({behind}, {}).reshape(1)), 0);
  EXPECT_EQ(draw({}, {through, broken}).size(), cv::Size(320, 240));
}

TEST(ModelDrawing, TransformedModelPredictsTheSameFrontsInTheOtherFrame) {
  const Eigen::Isometry3d T =
      Eigen::Translation3d(1, 2, 3) * Eigen::Isometry3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 0).normalized()));
  for (const core::LearnedModel& model : {test::doorModel(), test::drawerModel(), test::garageModel()})
    EXPECT_TRUE(transformed(model, T).predict(0.3).isApprox(T * model.predict(0.3), 1e-9)) << model.id;
  core::LearnedModel door = test::doorModel();
  door.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  const core::Matrix6d turned =
      transformed(door, Eigen::Isometry3d(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()))).covariance;
  EXPECT_NEAR(turned(0, 0), 2, 1e-12);
  EXPECT_NEAR(turned(4, 4), 4, 1e-12);
}

}  // namespace
}  // namespace cabinet_articulation
