// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/frame_bag.h"

#include <rosbag/view.h>

#include <optional>
#include <stdexcept>
#include <vector>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "config/ordinary_file.h"
#include "ros/images/compressed_images.h"
#include "tools/input/message_stream.h"

namespace cabinet_articulation {
namespace {

std::string stampText(const ros::Time& stamp) {
  char text[32];
  std::snprintf(text, sizeof text, "%u.%09u", stamp.sec, stamp.nsec);
  return text;
}

void openBag(const std::string& path, rosbag::Bag* bag) {
  core::requireOrdinaryFile(path);
  try {
    bag->open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(path + ": the bag was not closed or is cut off and has no index; 'rosbag reindex " + path +
                             "' saves what is readable");
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": not a complete bag file (" + error.what() + "); 'rosbag reindex " + path +
                             "' may save what is readable");
  }
}

template <class Message>
boost::shared_ptr<const Message> read(const rosbag::MessageInstance& instance, const std::string& path) {
  const boost::shared_ptr<const Message> message = readMessage<Message>(instance);
  if (!message) throw std::runtime_error(path + ": unreadable message on " + instance.getTopic());
  return message;
}

/// The newest that is not newer than `stamp`, else the first.
sensor_msgs::CameraInfoConstPtr infoAt(const std::map<ros::Time, sensor_msgs::CameraInfoConstPtr>& infos,
                                       const ros::Time& stamp) {
  const auto next = infos.upper_bound(stamp);
  return next == infos.begin() ? next->second : std::prev(next)->second;
}

std::string sizeText(const cv::Size& size) { return std::to_string(size.width) + "x" + std::to_string(size.height); }

cv::Size sizeOf(const sensor_msgs::Image& image) {
  return cv::Size(static_cast<int>(image.width), static_cast<int>(image.height));
}

/// What is wrong, in words; empty if the four are of one size.
std::string sizeTrouble(const sensor_msgs::Image& left, const sensor_msgs::Image& right, const sensor_msgs::CameraInfo& left_info,
                        const sensor_msgs::CameraInfo& right_info) {
  const cv::Size size = sizeOf(left);
  if (sizeOf(right) == size && imageSize(left_info) == size && imageSize(right_info) == size) return "";
  return "at " + std::to_string(left.header.stamp.toSec()) + " images " + sizeText(size) + " and " + sizeText(sizeOf(right)) +
         ", CameraInfos " + sizeText(imageSize(left_info)) + " and " + sizeText(imageSize(right_info));
}

/// What `view` makes of messages; nothing, and counted, where it refuses them.
template <class View>
std::optional<FrameViews> usable(const std_msgs::Header& header, const View& view, SkippedFrames* skipped) {
  try {
    requireStamp("header.stamp", header.stamp);
    return view();
  } catch (const std::invalid_argument& error) {
    skipped->add("messages that cannot be used", error.what());
    return {};
  }
}

}  // namespace

FrameBag::FrameBag(const std::string& path, const FrameBagOptions& options) : path_(path), options_(options) {
  openBag(path, &bag_);
  input_ = chooseInput(bag_, options.input);
}

size_t FrameBag::expectedFrames() const {
  return rosbag::View(bag_, rosbag::TopicQuery(input_.kind == "stereo" ? input_.topics.left : input_.topics.frame)).size();
}

void FrameBag::forEachFrame(const Callback& callback, SkippedFrames* skipped) {
  input_.kind == "stereo" ? forEachPair(callback, skipped) : forEachDepth(callback, skipped);
}

sensor_msgs::ImageConstPtr FrameBag::readImage(const rosbag::MessageInstance& instance, SkippedFrames* skipped) const {
  if (!instance.isType<sensor_msgs::CompressedImage>()) return read<sensor_msgs::Image>(instance, path_);
  try {
    return decompressed(*read<sensor_msgs::CompressedImage>(instance, path_), instance.getTopic());
  } catch (const std::invalid_argument& error) {
    skipped->add("images that cannot be decoded", error.what());
    return {};
  }
}

FrameBag::Infos FrameBag::readInfos(const std::string& topic) const {
  Infos infos;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag_, rosbag::TopicQuery(topic)))
    if (const auto info = readMessage<sensor_msgs::CameraInfo>(instance)) infos[info->header.stamp] = info;
  return infos;
}

void FrameBag::forEachPair(const Callback& callback, SkippedFrames* skipped) {
  const FrameTopics& topics = input_.topics;
  const Infos left_infos = readInfos(topics.info), right_infos = readInfos(topics.right_info);
  if (left_infos.empty()) throw std::runtime_error(path_ + ": no message on " + topics.info);
  if (right_infos.empty()) throw std::runtime_error(path_ + ": no message on " + topics.right_info);
  const std::string partner = options_.sync.tolerance() > 0 ? " image within the tolerance" : " image of the same stamp";
  PairMatcher<sensor_msgs::Image> matcher(options_.sync.tolerance(), [skipped, partner](Side side, const auto& image) {
    const char* const own = side == Side::kLeft ? "left" : "right";
    const char* const other = side == Side::kLeft ? "right" : "left";
    skipped->add(std::string(own) + " image without a " + other + partner, stampText(image->header.stamp));
  });
  for (const rosbag::MessageInstance& instance : rosbag::View(bag_, rosbag::TopicQuery({topics.left, topics.right}))) {
    const Side side = instance.getTopic() == topics.left ? Side::kLeft : Side::kRight;
    if (side == Side::kLeft) ++frames_read_;
    const sensor_msgs::ImageConstPtr image = readImage(instance, skipped);
    const auto pair = image ? matcher.add(side, image) : std::nullopt;
    if (!pair) continue;
    const std_msgs::Header& header = pair->left->header;
    const auto left = infoAt(left_infos, header.stamp), right = infoAt(right_infos, header.stamp);
    const std::string trouble = sizeTrouble(*pair->left, *pair->right, *left, *right);
    if (!trouble.empty())
      skipped->add("left and right image and their CameraInfos differ in size", trouble);
    else if (const auto views = usable(
                 header, [&] { return viewPair(*pair, *left, *right); }, skipped)) {
      if (options_.leave_out_unlit && projector_.lacksPattern(views->frame.left))
        skipped->add("the projector's pattern is missing, and comes and goes", stampText(header.stamp));
      else
        callback(header, *views);
    }
  }
  matcher.giveUpAll();
}

FrameViews FrameBag::viewPair(const ImagePair& pair, const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right) {
  const FrameTopics& topics = input_.topics;
  FrameViews views;
  views.frame.camera = toStereoCamera(left, right, topics.info, topics.right_info);
  views.left = toMono(pair.left, topics.left);
  views.right = toMono(pair.right, topics.right);
  views.frame.left = input_.rectified ? views.left->image : rectifiers_[0](views.left->image, left);
  views.frame.right = input_.rectified ? views.right->image : rectifiers_[1](views.right->image, right);
  return views;
}

void FrameBag::forEachDepth(const Callback& callback, SkippedFrames* skipped) {
  const FrameTopics& topics = input_.topics;
  const Infos infos = readInfos(topics.info), right_infos = readInfos(topics.right_info);
  if (infos.empty()) throw std::runtime_error(path_ + ": no message on " + topics.info);
  FrameInputConfig config = options_.frames;
  config.input = input_.kind;
  FrameAssembler assembler(config, options_.sync, topics, [&](const FrameMessages& messages) {
    if (const auto views = usable(
            messages.header(), [&] { return assembler.view(messages); }, skipped))
      callback(messages.header(), *views);
  });
  const auto comes = [this](const std::string& topic) { return rosbag::View(bag_, rosbag::TopicQuery(topic)).size() > 0; };
  if (comes(topics.left) && comes(topics.right)) assembler.expectImages();
  // The CameraInfos were read ahead, so that no frame comes before the first of them.
  play(
      &assembler,
      [&](const ros::Time& stamp) {
        assembler.addInfo(infoAt(infos, stamp));
        if (!right_infos.empty()) assembler.addRightInfo(infoAt(right_infos, stamp));
      },
      skipped);
  assembler.flush();
}

void FrameBag::play(FrameAssembler* assembler, const std::function<void(const ros::Time&)>& before_frame,
                    SkippedFrames* skipped) {
  const FrameTopics& topics = input_.topics;
  const rosbag::TopicQuery inputs({topics.frame, topics.left, topics.right});
  for (const rosbag::MessageInstance& instance : rosbag::View(bag_, inputs)) {
    if (instance.getTopic() == topics.frame) ++frames_read_;
    if (instance.isType<stereo_msgs::DisparityImage>()) {
      const auto disparity = read<stereo_msgs::DisparityImage>(instance, path_);
      before_frame(disparity->header.stamp);
      assembler->addDisparity(disparity);
      continue;
    }
    const sensor_msgs::ImageConstPtr image = readImage(instance, skipped);
    if (!image) continue;
    if (instance.getTopic() == topics.left) {
      assembler->addLeft(image);
    } else if (instance.getTopic() == topics.right) {
      assembler->addRight(image);
    } else {
      before_frame(image->header.stamp);
      assembler->addDepth(image);
    }
  }
}

}  // namespace cabinet_articulation
