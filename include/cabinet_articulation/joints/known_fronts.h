// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation::core {

/// What was learned about a front, and the observations it was learned from.
struct KnownFront {
  LearnedModel model;
  Track track;
};

std::vector<LearnedModel> modelsOf(const std::vector<KnownFront>& fronts);

/// A front as it was when it was forgotten on purpose.
struct ForgottenFront {
  ForgottenFront() = default;
  /// One that hangs on the world.
  ForgottenFront(LearnedModel of_the_world) : model(std::move(of_the_world)) {}

  LearnedModel model;                   ///< placed in the world, with the number of its parent
  std::optional<Rectangle> parent;      ///< in the world: the front that it hung on; none if that is not known
  std::vector<std::uint32_t> set_down;  ///< ids of fronts that hung on it: they hang on the world since
  std::vector<std::uint32_t> lost;      ///< ids of those whose place nobody knows without it: they are forgotten, too
};

/// ", and front 4, which hung on it, hangs on the world now", for all of them; empty if nothing hung on it.
std::string childrenInWords(const ForgottenFront& forgotten);

/// A front cannot be called so. The message says why, and what would do.
class NameError : public ModelError {
 public:
  NameError(const std::string& why, const std::string& proposal)
      : ModelError(why + "; '" + proposal + "' would do"), proposal_(proposal) {}

  /// Fits and is free.
  const std::string& proposal() const { return proposal_; }

 private:
  std::string proposal_;
};

/// A front that got another id, because that was taken or was none.
struct IdChange {
  std::uint32_t from = 0, to = 0;
};

/// "front 3 of the file is front 7 now", for all of them; empty if there are none.
std::string inWords(const std::vector<IdChange>& changes);

/// A front that got another name, because that was taken.
struct NameChange {
  std::uint32_t id = 0;
  std::string from, to;
};

/// Observations that are kept of a front out of view, or in a file: enough for the fits, which use no more themselves.
constexpr int kKeptObservations = 200;

/// Everything that was learned: the fronts in view, and the joints that are out of view.
///
/// A joint stays known until its own model says that it is given up. A front in view whose model tells less at the moment does
/// not erase it. What is given up stays, with its doubt, but answers no questions any more.
class KnownFronts {
 public:
  /// So many joints are remembered beside those in view; those without a name, with the fewest observations, go first, but
  /// none before what hangs on it (some 50 MB, ours).
  static constexpr std::size_t kMostRemembered = 256;

  /// Names that are kept for fronts nobody knows at the moment, in case that their ids return (ours).
  static constexpr std::size_t kMostNames = 1024;

  /// Puts the tracks of one frame together. Returns how many wait for being sent as a whole (see TrackAssembly).
  std::size_t follow(std::vector<TrackUpdate> updates);

  /// In view.
  const std::vector<Track>& tracks() const { return tracks_.tracks(); }

  /// The models of those tracks. Joints that are no longer among them are remembered, if they were seen often enough to be
  /// more than an arm that passed.
  void update(const std::vector<LearnedModel>& models);

  /// Gives a front a name, which stays with its id. Names are a letter, then up to 63 letters, digits and underscores. Throws
  /// NameError for all others, and for what is taken: by a front that is known, as another's default name, or `reserved`. Throws
  /// ModelError for an id nobody knows.
  void setName(std::uint32_t id, const std::string& name, const std::string& reserved = "");

  /// Puts the names of their fronts into models, which learners do not know.
  void giveNames(std::vector<LearnedModel>* models) const;

  /// Throws ModelError for an id nobody knows.
  const LearnedModel& at(std::uint32_t id) const;

  /// All joints worth remembering, in view or not, given up or not, ordered by id.
  std::vector<KnownFront> joints() const;

  /// Their models alone, which is much less to copy.
  std::vector<LearnedModel> jointModels() const;

  /// Forgets everything and remembers these.
  void replace(std::vector<KnownFront> fronts);

  /// Forgets one front and returns what it was. What hung on it stays where it is, and hangs on the world from now on. Throws
  /// ModelError for an id nobody knows.
  ForgottenFront forget(std::uint32_t id);

 private:
  struct Kept {
    const LearnedModel* model;
    const Track* track;
  };

  bool isKnown(std::uint32_t id) const { return live_.count(id) > 0 || remembered_.count(id) > 0; }
  std::string nameGiven(std::uint32_t id) const;
  std::string whyNotNamed(std::uint32_t id, const std::string& name, const std::string& reserved) const;
  void dropNamesOfUnknown(const std::string& name);
  std::map<std::uint32_t, Kept> worthKeeping() const;
  const Track* trackOf(std::uint32_t id) const;
  void remember(KnownFront front);
  std::vector<LearnedModel> allModels() const;
  void setDownChildren(const std::vector<LearnedModel>& all, ForgottenFront* forgotten);

  TrackAssembly tracks_;                  ///< in view
  std::map<std::uint32_t, Track> ended_;  ///< out of view since the last update
  std::map<std::uint32_t, LearnedModel> live_;
  std::map<std::uint32_t, std::string> names_;
  std::map<std::uint32_t, KnownFront> remembered_;  ///< without those that `live_` has with a joint worth keeping
};

}  // namespace cabinet_articulation::core
