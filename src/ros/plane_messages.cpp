// SPDX-License-Identifier: BSD-3-Clause
#include "ros/plane_messages.h"

#include <mutex>
#include <utility>

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

}  // namespace cabinet_articulation
