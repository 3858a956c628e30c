// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <string>

namespace cabinet_articulation {

/// The image in a message of image_transport's `compressed` (JPEG, PNG) or `compressedDepth` (PNG): what the plugins of
/// image_transport make of it, with the header of the message. Colours may stand in another order than they were sent in, as the
/// encoding says. compressedDepth of floating point images holds quantized inverse depth; 0 becomes NaN.
/// Throws std::invalid_argument that names the topic, the format and those that can be read.
sensor_msgs::ImagePtr decompressed(const sensor_msgs::CompressedImage& message, const std::string& topic);

/// True if the format of a message says that it holds depth (16UC1, mono16 or 32FC1).
bool holdsDepth(const sensor_msgs::CompressedImage& message);

}  // namespace cabinet_articulation
