// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/overlay_labels.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/joints/joint.h"
#include "ros/drawing/label_layout.h"
#include "ros/images/image_color.h"

namespace cabinet_articulation {
namespace {

constexpr double kFontScale = 0.42;
constexpr int kStrip = 4;      ///< [px] in the front's colour, at the left
constexpr int kPadding = 3;    ///< [px] around text
constexpr int kText = 10;      ///< [px] height of a line's letters
constexpr int kBar = 4;        ///< [px] height of a gauge
constexpr double kDark = 0.8;  ///< opacity of a box
const cv::Scalar kInk = cv::Scalar::all(255), kPaper = cv::Scalar::all(20), kEmptyBar = cv::Scalar::all(90);

int widthOf(const std::string& line) { return cv::getTextSize(line, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr).width; }

/// Cut off where it is wider than `most` pixels; no letter is narrower than one.
std::string fitted(std::string line, int most) {
  line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(most, 0)) + 1));
  if (widthOf(line) <= most) return line;
  while (!line.empty() && widthOf(line + "...") > most) line.pop_back();
  return line + "...";
}

std::vector<std::string> linesOf(const std::string& text, int most) {
  std::vector<std::string> lines = labelLines(text);
  for (std::string& line : lines) line = fitted(line, most);
  return lines;
}

int heightOf(const OverlayLabel& label) { return kText + 2 * kPadding + (label.gauge ? kBar + 2 : 0); }

void drawBar(const cv::Rect& bar, double share, const cv::Scalar& color, cv::Mat3b* image) {
  cv::rectangle(*image, bar, kEmptyBar, cv::FILLED);
  const cv::Rect filled(bar.tl(), cv::Size(cvRound(share * bar.width), bar.height));
  if (filled.width > 0) cv::rectangle(*image, filled, color, cv::FILLED);
}

void drawBox(const OverlayLabel& label, const std::vector<std::string>& lines, const cv::Rect& box, cv::Mat3b* image) {
  cv::Mat3b inside = (*image)(box);
  cv::addWeighted(inside, 1 - kDark, cv::Mat3b(box.size(), cv::Vec3b(20, 20, 20)), kDark, 0, inside);
  cv::rectangle(*image, cv::Rect(box.x, box.y, kStrip, box.height), imageColor(label.color), cv::FILLED);
  const int left = box.x + kStrip + kPadding;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int top = box.y + static_cast<int>(i) * heightOf(label) + kPadding;
    cv::putText(*image, lines[i], {left, top + kText}, cv::FONT_HERSHEY_SIMPLEX, kFontScale, kInk, 1, cv::LINE_AA);
    if (!label.gauge) continue;
    const cv::Rect bar(left, top + kText + kPadding + 1, box.br().x - kPadding - left, kBar);
    drawBar(bar, i == 0 ? label.gauge->probability : label.gauge->opening, imageColor(label.color), image);
  }
}

void drawLeader(const OverlayLabel& label, const cv::Rect& box, cv::Mat3b* image) {
  if (box.contains(label.at)) return;
  const cv::Point nearest(std::clamp(label.at.x, box.x, box.br().x - 1), std::clamp(label.at.y, box.y, box.br().y - 1));
  cv::line(*image, label.at, nearest, kPaper, 3, cv::LINE_AA);
  cv::line(*image, label.at, nearest, imageColor(label.color), 1, cv::LINE_AA);
}

}  // namespace

std::optional<LabelGauge> gaugeOf(const core::LearnedModel& model) {
  if (!core::isJoint(model)) return std::nullopt;
  const auto share = [](double value) { return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0; };
  const double seen = (model.q - model.q_min) / (model.q_max - model.q_min);
  return LabelGauge{share(core::typeProbability(model)), share(model.closed_known ? model.opening : seen)};
}

void drawLabels(std::vector<OverlayLabel> labels, cv::Mat3b* image) {
  std::stable_partition(labels.begin(), labels.end(), [](const OverlayLabel& label) { return label.gauge.has_value(); });
  std::vector<std::vector<std::string>> lines;
  std::vector<LabelBox> boxes;
  for (const OverlayLabel& label : labels) {
    lines.push_back(linesOf(label.text, image->cols - kStrip - 2 * kPadding));
    int width = 0;
    for (const std::string& line : lines.back()) width = std::max(width, widthOf(line));
    const int height = static_cast<int>(lines.back().size()) * heightOf(label) + (label.gauge ? kPadding : 0);
    boxes.push_back({cv::Size(kStrip + width + 2 * kPadding, height), label.at});
  }
  const std::vector<std::optional<cv::Rect>> places = placeLabels(boxes, image->size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (places[i]) drawLeader(labels[i], *places[i], image);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (places[i]) drawBox(labels[i], lines[i], *places[i], image);
}

}  // namespace cabinet_articulation
