// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/plane_messages.h"

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/image_conversions.h"

namespace cabinet_articulation {

/// Never more than were in use at once.
struct PlaneMessages::SpareMasks {
  using Pixels = sensor_msgs::Image::_data_type;

  void lend(PlaneArray* message) {
    std::lock_guard<std::mutex> lock(mutex);
    for (Plane& plane : message->planes) {
      if (pixels.empty()) return;
      plane.mask.data = std::move(pixels.back());
      pixels.pop_back();
    }
  }

  void takeBack(PlaneArray* message) {
    std::lock_guard<std::mutex> lock(mutex);
    for (Plane& plane : message->planes) pixels.push_back(std::move(plane.mask.data));
  }

  std::mutex mutex;
  std::vector<Pixels> pixels;
};

PlaneMessages::PlaneMessages() : spare_(std::make_shared<SpareMasks>()) {}

PlaneArrayPtr PlaneMessages::make(const std::vector<core::PlaneRegion>& regions, const std_msgs::Header& header) {
  const auto release = [spare = spare_](PlaneArray* message) {
    spare->takeBack(message);
    delete message;
  };
  const PlaneArrayPtr message(new PlaneArray, release);
  message->header = header;
  message->planes.resize(regions.size());
  spare_->lend(message.get());
  for (size_t i = 0; i < regions.size(); ++i) toMessage(regions[i], header, &message->planes[i]);
  return message;
}

std::vector<double> toMessage(const core::BendVector& bend) {
  return bend.isZero(0) ? std::vector<double>() : std::vector<double>(bend.data(), bend.data() + bend.size());
}

core::BendVector bendOf(const PlaneArray& message) {
  if (message.bend.empty()) return core::BendVector::Zero();
  if (message.bend.size() != core::kBendTerms)
    throw std::invalid_argument("bend has " + std::to_string(message.bend.size()) + " terms, expected " +
                                std::to_string(core::kBendTerms) + ", or none");
  for (const double term : message.bend) core::requireWithin("bend", term, core::limits::kBend);
  return core::BendVector(message.bend.data());
}

}  // namespace cabinet_articulation
