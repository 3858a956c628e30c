// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/image_edge.h"
#include "rectangles/edges/side_face.h"

namespace cabinet_articulation::core {

/// Where a surface ends in a depth image, from strips of pixels parallel to one edge of a rectangle (ours). A mask follows a
/// board over its side face for as long as the depth's noise allows: 1 to 5 cm at 2 m. The mean of a strip has a tenth of that
/// noise. Its windows make a depth camera lose pixels on both sides of an edge, so there the pixels that have a depth decide.
class DepthEdge {
 public:
  struct Place {
    double offset = 0;  ///< [px] outward from where the edge was
    bool face = false;  ///< the board's side face begins there
  };

  /// `face`: that can be seen at this edge.
  DepthEdge(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge, const SideFace& face);

  /// Nothing if the surface does not end within reach, or if another region or something in front hides its end.
  std::optional<Place> whole() const { return place({0, 1}); }
  /// Of the half from the edge's end `a` to its middle (0), or from there to `b` (1).
  std::optional<Place> half(int index) const { return place({index, index}); }

  /// [px] outward: where the surface of a neighbour begins that comes nearer by `slope` [px/px] outward. Nothing if its strips
  /// are explained about as well without it. A bend of the sensor is the same on both sides, so it moves the place by
  /// little: by less than 2 px where it moves the line in which the planes meet by 7 px.
  std::optional<double> crease(double slope) const;

 private:
  static constexpr int kInside = 16;   ///< [px] covered inside the edge
  static constexpr int kOutside = 12;  ///< [px] covered outside
  static constexpr int kStrips = kInside + kOutside;

  struct Pixel {
    std::int8_t strip, half;
    bool in_plane;
    bool hidden;     ///< by something in front, or by another region
    bool near;       ///< within the tolerance of the plane, whose region ever it is in
    float residual;  ///< [px] of the disparity beside the plane's; NaN: no depth
  };

  /// Counts of a strip's pixels.
  struct Strip {
    int seen = 0, hidden = 0;
    int valid = 0;         ///< of those seen, with a depth
    int surface = 0;       ///< on the plane, or on its side face
    int measured = 0;      ///< of those, with a depth; the others are small holes in the surface
    double residuals = 0;  ///< [px] sum over those
  };
  using Strips = std::array<Strip, kStrips>;

  struct Halves {
    int first, last;
  };

  static double placeOf(int strip) { return strip + 0.5 - kInside; }
  static std::optional<double> endOf(const Strips& strips);
  static double measuredShare(const Strips& strips, int k);

  void addPixels(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge);
  void measureNoise();
  std::optional<Place> place(Halves halves) const;
  Strips strips(Halves halves, double face_begin) const;
  double faceBegin(const Strips& strips, double end) const;
  static double creaseCost(const Strips& strips, double slope, double begin);
  double evidence() const;

  SideFace face_;
  std::vector<Pixel> pixels_;
  double off_middle_ = 0;        ///< [px] of the pixels from the middles of their strips; an edge may run along the image's rows
  double mean_ = 0, sigma_ = 0;  ///< [px] of residuals well inside; sigma 0: none was seen
};

}  // namespace cabinet_articulation::core
