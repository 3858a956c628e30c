// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include "simulation/cabinet_builder.h"
#include "simulation/scene_factories.h"

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

constexpr double kDepth = 0.56;  // [m] of the base cabinets
constexpr double kWall = 0.60;   // [m] y of the wall behind them
constexpr double kWorktopThickness = 0.04;
constexpr double kRoom = 3.0;  // [m] half the length of the wall

/// One cabinet of the row: a drawer above a door, or three drawers.
struct Column {
  bool door;
  double width;
};

struct Heights {
  double plinth, top, drawer;
};

/// What moves: the column of the drawer and of the door, -1 if none does.
struct Movers {
  int drawer = -1;
  int door = -1;
};

class Kitchen {
 public:
  Kitchen(bool hinge_left, cv::RNG* random)
      : random_(random),
        hinge_left_(hinge_left),
        materials_(Materials::random(random)),
        builder_(&scene_, materials_, random->uniform(0.003, 0.004)) {
    heights_.plinth = random->uniform(0.10, 0.15);
    heights_.drawer = random->uniform(0.122, 0.132);
    heights_.top = heights_.plinth + heights_.drawer + random->uniform(0.56, 0.60);
    // Two columns with a drawer above a door stand in the middle of the picture.
    columns_ = {{false, randomWidth(0.45)},
                {true, randomWidth(0.40)},
                {true, randomWidth(0.40)},
                {false, randomWidth(0.50)},
                {true, randomWidth(0.60)}};
    left_ = -columns_[0].width - columns_[1].width;
  }

  Scene build(const Movers& movers) {
    double x = left_;
    for (int i = 0; i < static_cast<int>(columns_.size()); x += columns_[i].width, ++i) addColumn(i, x, movers);
    addWorktop(left_, x);
    addWallCabinets();
    addRoom();
    return scene_;
  }

  Slot slot(int column) const {
    double x = left_;
    for (int i = 0; i < column; ++i) x += columns_[i].width;
    return {x, x + columns_[column].width, heights_.plinth, heights_.top};
  }

  double drawerBottom() const { return heights_.top - heights_.drawer; }

 private:
  double randomWidth(double width) { return width * random_->uniform(0.96, 1.04); }

  void addColumn(int index, double x, const Movers& movers) {
    const Column& column = columns_[index];
    const std::string name = "column_" + std::to_string(index);
    const Slot whole{x, x + column.width, heights_.plinth, heights_.top};
    Slot upper = whole, lower = whole;
    upper.z0 = lower.z1 = drawerBottom();
    if (index == movers.door || index == movers.drawer) {
      builder_.addCarcass(whole, kDepth);
      builder_.addShelf(whole, drawerBottom() - 0.01, kDepth);
    }
    if (index == movers.drawer)
      builder_.addDrawer("drawer", upper, random_->uniform(0.27, 0.33));
    else
      builder_.addFixedFront(name + "/drawer", upper, Handle::kHorizontal);
    if (!column.door) {
      const double middle = (lower.z0 + lower.z1) / 2;
      builder_.addFixedFront(name + "/drawer_2", {lower.x0, lower.x1, middle, lower.z1}, Handle::kHorizontal);
      builder_.addFixedFront(name + "/drawer_3", {lower.x0, lower.x1, lower.z0, middle}, Handle::kHorizontal);
    } else if (index == movers.door) {
      builder_.addShelf(whole, heights_.plinth + 0.3, kDepth - 0.05);
      builder_.addDoor("door", lower, hinge_left_, radians(random_->uniform(75, 85)));
    } else {
      builder_.addFixedFront(name + "/door", lower, hinge_left_ ? Handle::kVerticalRight : Handle::kVerticalLeft);
    }
  }

  void addWorktop(double x0, double x1) {
    const double top = heights_.top + kWorktopThickness;
    builder_.addFixedBox({x0 - 0.01, -0.02, heights_.top}, {x1 + 0.01, kWall, top}, materials_.worktop);
    builder_.addFixedBox({x0, 0.05, 0}, {x1, 0.07, heights_.plinth}, materials_.plinth);
    builder_.addFixedBox({x0 - 0.016, 0, 0}, {x0 - 0.001, kDepth, heights_.top}, materials_.body);  // end panels
    builder_.addFixedBox({x1 + 0.001, 0, 0}, {x1 + 0.016, kDepth, heights_.top}, materials_.body);
    for (int i = 0; i < 4; ++i) {  // things that stand about
      const double x = random_->uniform(x0 + 0.1, x1 - 0.3), y = random_->uniform(0.15, 0.35);
      builder_.addFixedBox({x, y, top},
                           {x + random_->uniform(0.08, 0.25), y + random_->uniform(0.08, 0.2), top + random_->uniform(0.1, 0.3)},
                           random_->uniform(0.2, 0.8));
    }
  }

  void addWallCabinets() {
    double x = left_ - 0.1;
    for (int i = 0; i < 4; ++i) {
      const double width = randomWidth(0.5);
      constexpr double kBottom = 1.45, kTop = 2.15, kFront = 0.25;
      builder_.addFixedBox({x + 0.002, kFront, kBottom}, {x + width - 0.002, kWall, kTop}, materials_.front);
      x += width;
    }
  }

  void addRoom() {
    Rectangle wall;
    wall.pose.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    wall.pose.translation() = Vector3d(0, kWall, 1.25);
    wall.width = 2 * kRoom;
    wall.height = 2.5;
    builder_.addRoomPlane("wall", wall, materials_.wall);
    Rectangle floor;
    floor.pose.translation() = Vector3d(0, kWall - kRoom, 0);
    floor.width = floor.height = 2 * kRoom;
    builder_.addRoomPlane("floor", floor, materials_.floor);
    for (const double side : {-1.0, 1.0}) {
      Rectangle end;
      end.pose.linear() << 0, 0, -side, -side, 0, 0, 0, 1, 0;
      end.pose.translation() = Vector3d(side * kRoom, kWall - kRoom, 1.25);
      end.width = 2 * kRoom;
      end.height = 2.5;
      scene_.surfaces.push_back({end, materials_.wall, kFixedPart});
    }
  }

  cv::RNG* random_;
  bool hinge_left_;
  Materials materials_;
  Scene scene_;
  CabinetBuilder builder_;
  Heights heights_;
  std::vector<Column> columns_;
  double left_ = 0;
};

}  // namespace

Scene makeKitchen(const std::string& kind, bool hinge_left, cv::RNG* random) {
  Kitchen kitchen(hinge_left, random);
  // The drawer stands on the hinge's side, where the open door does not hide it.
  const int door_column = hinge_left ? 2 : 1;
  const int drawer_column = kind == "kitchen" ? 3 - door_column : 1;
  Movers movers;
  if (kind == "door" || kind == "kitchen") movers.door = door_column;
  if (kind == "drawer" || kind == "kitchen") movers.drawer = drawer_column;
  Scene scene = kitchen.build(movers);

  const double hinge_side = hinge_left ? -1 : 1;
  const Slot door = kitchen.slot(door_column);
  const Slot drawer = kitchen.slot(drawer_column);
  Vector3d target(0.05 * hinge_side, -0.1, kitchen.drawerBottom() - 0.18);
  double distance = random->uniform(1.45, 1.55);
  double azimuth = radians(random->uniform(25, 33)) * hinge_side;
  if (kind == "door") {
    target = {(door.x0 + door.x1) / 2 + 0.05 * hinge_side, -0.1, (door.z0 + kitchen.drawerBottom()) / 2 + 0.05};
    distance = random->uniform(1.25, 1.40);
    azimuth = radians(random->uniform(32, 42)) * hinge_side;
  } else if (kind == "drawer") {
    target = {(drawer.x0 + drawer.x1) / 2, -0.1, kitchen.drawerBottom() - 0.05};
    distance = random->uniform(1.20, 1.35);
  }
  scene.view_target = target;
  scene.view_point = viewPoint(target, distance, azimuth, radians(random->uniform(22, 27)));
  // The arm reaches in from above, so that it hides little of the front.
  scene.shoulder = target + Vector3d(-0.10 * hinge_side, -0.50, 1.0);
  return scene;
}

}  // namespace cabinet_articulation::core
