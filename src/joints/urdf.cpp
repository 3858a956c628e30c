// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/urdf.h"

#include <boost/locale/utf.hpp>
#include <cstdio>
#include <memory>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/hanging.h"
#include "joints/furniture.h"
#include "joints/urdf_document.h"

namespace cabinet_articulation::core {
namespace {

// What a camera cannot see, and a description must have (ours: an ordinary kitchen front).
constexpr double kThickness = 0.02;  // [m]
constexpr double kDensity = 700;     // [kg/m^3] wood
constexpr double kEffort = 100;      // [N or Nm]
constexpr double kVelocity = 1;      // [m/s or rad/s]
constexpr char kMaterial[] = "wood";
constexpr char kFixed[] = "-fixed";    // no front has a name with a hyphen
constexpr double kLeastLength = 0.01;  // [m] of a panel's side, for a positive inertia

urdf::Pose toPose(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  urdf::Pose result;
  result.position = {pose.translation().x(), pose.translation().y(), pose.translation().z()};
  result.rotation = {q.x(), q.y(), q.z(), q.w()};
  return result;
}

/// Behind the front's surface.
urdf::Pose panelPose() {
  urdf::Pose pose;
  pose.position.z = -kThickness / 2;
  return pose;
}

/// Of a homogeneous box.
urdf::InertialSharedPtr inertiaOf(const urdf::Box& box) {
  const urdf::Vector3& d = box.dim;
  const auto inertial = std::make_shared<urdf::Inertial>();
  inertial->origin = panelPose();
  inertial->mass = kDensity * d.x * d.y * d.z;
  inertial->ixx = inertial->mass / 12 * (d.y * d.y + d.z * d.z);
  inertial->iyy = inertial->mass / 12 * (d.x * d.x + d.z * d.z);
  inertial->izz = inertial->mass / 12 * (d.x * d.x + d.y * d.y);
  return inertial;
}

urdf::MaterialSharedPtr wood() {
  const auto material = std::make_shared<urdf::Material>();
  material->name = kMaterial;
  material->color.r = 0.76F;
  material->color.g = 0.6F;
  material->color.b = 0.42F;
  material->color.a = 1;
  return material;
}

/// XML has no way to write control characters, nor bytes that are no UTF-8.
bool fitsXml(boost::locale::utf::code_point c) {
  return boost::locale::utf::is_valid_codepoint(c) && (c >= 0x20 || c == '\t' || c == '\n' || c == '\r') && c != 0xFFFE &&
         c != 0xFFFF;
}

/// Throws ModelError for a name that a description cannot hold. `what` it is the name of, in words.
void requireName(const std::string& name, const std::string& what) {
  for (auto at = name.begin(); at != name.end();) {
    const auto position = at - name.begin();
    if (fitsXml(boost::locale::utf::utf_traits<char>::decode(at, name.end()))) continue;
    char byte[8];
    std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(name[static_cast<std::size_t>(position)]));
    throw ModelError(what + " has the byte " + byte + " at position " + std::to_string(position + 1) +
                     ", which a URDF cannot hold; expected printable UTF-8");
  }
}

/// A link that joints hang on.
struct Body {
  std::string link;
  Eigen::Isometry3d T_frame_link;
};

class Description {
 public:
  Description(const std::string& frame, const std::string& prefix) : prefix_(prefix) {
    if (frame.empty()) throw ModelError("the frame of the models has no name, and becomes the name of the root link");
    requireName(frame, "the frame of the models");
    requireName(prefix, "the prefix of the names");
    description_.name_ = prefix;
    addLink(frame);
    description_.root_link_ = description_.links_.at(frame);
    frame_ = frame;
  }

  /// A link that joints hang on, at the middle of these closed fronts. The first lends its name and its axes.
  Body addBody(const LearnedModel& first, const PieceOfFurniture& piece) {
    const std::string name = nameFor(first) + "_body";
    Eigen::Isometry3d T_frame_body = piece.closed.front();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Isometry3d& front : piece.closed) sum += front.translation();
    T_frame_body.translation() = sum / static_cast<double>(piece.closed.size());
    addLink(name);
    connect(name + kFixed, frame_, name, T_frame_body);
    return {name, T_frame_body};
  }

  /// The front that another one hangs on. Poses of the latter are in its frame.
  Body frontOf(const LearnedModel& hanging) const {
    return {prefix_ + "_" + std::to_string(hanging.parent) + "_front", Eigen::Isometry3d::Identity()};
  }

  /// What joints hang on that share no body.
  Body room() const { return {frame_, Eigen::Isometry3d::Identity()}; }

  void add(const LearnedModel& model, const Body& body) {
    requireName(nameOf(model), "the name of front " + std::to_string(model.id));
    const std::string name = nameFor(model);
    const Eigen::Isometry3d T_frame_base = jointBase(model);
    addLink(name + "_base");
    addLink(name + "_leaf");
    addPanel(addLink(name + "_front"), model);
    connect(name + "_base" + kFixed, body.link, name + "_base", body.T_frame_link.inverse() * T_frame_base);
    connect(name + "_front" + kFixed, name + "_leaf", name + "_front", T_frame_base.inverse() * model.origin);
    if (!model.name.empty()) {
      addLink(prefix_ + "_" + model.name);
      connect(name + "_name" + kFixed, name + "_front", prefix_ + "_" + model.name, Eigen::Isometry3d::Identity());
    }
    const urdf::JointSharedPtr joint = connect(nameOf(model), name + "_base", name + "_leaf", Eigen::Isometry3d::Identity());
    const bool turns = modelEntry(model.type).urdf == UrdfJoint::kRevolute;
    joint->type = turns ? urdf::Joint::REVOLUTE : urdf::Joint::PRISMATIC;
    joint->axis = {0, 0, 1};
    joint->limits = std::make_shared<urdf::JointLimits>();
    joint->limits->lower = model.q_min;
    joint->limits->upper = model.q_max;
    joint->limits->effort = kEffort;
    joint->limits->velocity = kVelocity;
  }

  std::string text() const {
    const std::unique_ptr<UrdfDocument> document(urdf::exportURDF(description_));
    UrdfPrinter printer;
    document->Accept(&printer);
    return printer.CStr();
  }

 private:
  std::string nameFor(const LearnedModel& model) const { return prefix_ + "_" + std::to_string(model.id); }

  /// Throws ModelError for a name that is there already: such a description has no root, or two.
  urdf::LinkSharedPtr addLink(const std::string& name) {
    if (description_.links_.count(name) > 0)
      throw ModelError("there are two links '" + name + "'; give each front once, and the frame another name than a front's");
    const auto link = std::make_shared<urdf::Link>();
    link->name = name;
    description_.links_[name] = link;
    return link;
  }

  urdf::JointSharedPtr connect(const std::string& name, const std::string& parent, const std::string& child,
                               const Eigen::Isometry3d& T_parent_child) {
    if (description_.joints_.count(name) > 0)
      throw ModelError("there are two joints '" + name + "'; give each front a name of its own");
    const auto joint = std::make_shared<urdf::Joint>();
    joint->name = name;
    joint->type = urdf::Joint::FIXED;
    joint->parent_link_name = parent;
    joint->child_link_name = child;
    joint->parent_to_joint_origin_transform = toPose(T_parent_child);
    description_.joints_[name] = joint;
    return joint;
  }

  void addPanel(const urdf::LinkSharedPtr& link, const LearnedModel& model) {
    const auto box = std::make_shared<urdf::Box>();
    box->dim = {std::max(model.width, kLeastLength), std::max(model.height, kLeastLength), kThickness};
    link->visual = std::make_shared<urdf::Visual>();
    link->visual->origin = panelPose();
    link->visual->geometry = box;
    link->visual->material_name = kMaterial;
    link->visual->material = wood();
    link->visual_array.push_back(link->visual);
    link->collision = std::make_shared<urdf::Collision>();
    link->collision->origin = panelPose();
    link->collision->geometry = box;
    link->collision_array.push_back(link->collision);
    link->inertial = inertiaOf(*box);
  }

  urdf::ModelInterface description_;
  std::string prefix_, frame_;
};

}  // namespace

bool hasUrdf(const LearnedModel& model) { return isJoint(model) && modelEntry(model.type).urdf != UrdfJoint::kNone; }

std::string toUrdf(const std::vector<LearnedModel>& models, const std::string& frame, const std::string& prefix) {
  Description description(frame, prefix);
  for (const LearnedModel& model : models) {
    requireJoint(model);
    if (!hasUrdf(model))
      throw ModelError("front " + std::to_string(model.id) + " is " + modelName(model.type) +
                       ", and URDF has only prismatic and rotational joints");
  }
  const std::vector<LearnedModel> of_the_world = thoseOfTheWorld(models);
  for (const PieceOfFurniture& piece : piecesOfFurniture(of_the_world)) {
    const Body body =
        piece.fronts.size() > 1 ? description.addBody(of_the_world[piece.fronts.front()], piece) : description.room();
    for (const std::size_t front : piece.fronts) description.add(of_the_world[front], body);
  }
  for (const LearnedModel& model : models) {
    if (model.parent == 0) continue;
    frameOf(model, models);  // throws for a parent that is not there
    description.add(model, description.frontOf(model));
  }
  return description.text();
}

}  // namespace cabinet_articulation::core
