// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/model_file.h"

#include <filesystem>
#include <optional>

#include "cabinet_articulation/joints/hanging.h"
#include "config/ordinary_file.h"
#include "joints/front_merge.h"
#include "joints/kind_fields.h"
#include "joints/model_text.h"
#include "joints/safe_file.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;

/// [bytes] Ours: a front takes some 50 kB, 90 kB at most, so that nearly 3000 fit.
constexpr std::size_t kLargestFile = 256U << 20U;

template <class Work>
auto onFile(const std::string& path, const Work& work) {
  return withErrorsOf<ModelFileError>("model file '" + path + "'", work);
}

/// What the file held that is there, or why it cannot be merged.
struct Found {
  std::optional<ModelFile> models;
  std::vector<JointShape> kinds;  ///< can be merged whatever their frame
  std::string why_not;
};

/// Throws for what is there and never was a model file.
Found lookAt(const fs::path& file) {
  Found found;
  std::optional<std::string> text;
  try {
    text = readFileIfThere(file, kLargestFile);
    if (text) found.models = modelsFromText(*text);
    if (found.models) found.kinds = found.models->kinds;
  } catch (const std::exception& error) {
    if (!text || !wasModelFile(*text))
      throw std::runtime_error(std::string(error.what()) + "; it is left as it is, and nothing is saved");
    found.why_not = error.what();
  }
  return found;
}

/// Fronts that can only be placed apart cannot be merged.
MergedFronts merge(const ModelFile& models, const std::vector<ForgottenFront>& removed, Found* found) {
  requireNoCycle(modelsOf(models.fronts));
  MergedFronts merged = mergeFronts(models.fronts, found->models ? found->models->fronts : std::vector<KnownFront>(), removed);
  try {
    requireNoCycle(modelsOf(merged.fronts));
    return merged;
  } catch (const ModelError& error) {
    found->why_not = error.what();
    found->models.reset();
    return mergeFronts(models.fronts, {}, removed);
  }
}

}  // namespace

std::string SavedModels::inWords(const std::string& file) const {
  std::string text = std::to_string(fronts) + " fronts saved to '" + file + "'";
  if (from_file > 0) text += ", " + std::to_string(from_file) + " of them as the file had them";
  const std::string changed = core::inWords(changes);
  if (!changed.empty()) text += "; " + changed;
  for (const IdChange& change : known_changes)
    text += "; front " + std::to_string(change.from) + " is front " + std::to_string(change.to) + " there";
  for (const NameChange& change : renamed)
    text += "; front " + std::to_string(change.id) + " of the file is called '" + change.to + "' there, for another is '" +
            change.from + "' now";
  if (kinds > 0) text += "; and the joints of " + std::to_string(kinds) + " fronts that are not known any more, for their kinds";
  if (!kept.empty()) text += "; " + kept;
  return text;
}

SavedModels saveModelFile(const std::string& path, const ModelFile& models, const std::vector<ForgottenFront>& removed) {
  return onFile(path, [&] {
    const fs::path file = followLinks(path);
    const FolderLock lock(file.parent_path());
    Found found = lookAt(file);
    // Nothing has no frame, and replaces nothing.
    const bool other_frame = found.models && found.models->frame != models.frame;
    if (other_frame && models.fronts.empty() && !found.models->fronts.empty())
      return SavedModels{found.models->fronts.size(), found.models->fronts.size(), {}};
    if (other_frame && !found.models->fronts.empty()) {
      found.why_not = "its poses are in the frame '" + found.models->frame + "', and the new ones in '" + models.frame + "'";
      found.models.reset();
    }
    SavedModels saved;
    MergedFronts merged = merge(models, removed, &found);
    saved.fronts = merged.fronts.size();
    saved.from_file = merged.from_file;
    saved.known_changes = merged.known_changes;
    saved.renamed = merged.renamed;
    if (found.models) saved.changes = found.models->changes;
    saved.changes.insert(saved.changes.end(), merged.changes.begin(), merged.changes.end());
    ModelFile united_models{models.frame, std::move(merged.fronts)};
    united_models.kinds = united(models.kinds, models.replaces_kinds ? std::vector<JointShape>() : found.kinds);
    saved.kinds = united_models.kinds.size();
    const std::string text = toText(united_models);
    if (found.why_not.empty()) {
      replaceFile(file, text, lock);
    } else {
      const fs::path kept = keepAndReplaceFile(file, text, lock);
      saved.kept = "the file that was there cannot be merged (" + found.why_not + ") and is kept as '" + kept.string() + "'";
    }
    return saved;
  });
}

std::size_t removeFromModelFile(const std::string& path, const std::string& frame, const std::vector<ForgottenFront>& removed,
                                const std::vector<JointShape>& kinds) {
  return onFile(path, [&]() -> std::size_t {
    const fs::path file = followLinks(path);
    const FolderLock lock(file.parent_path());
    const std::optional<std::string> text = readFileIfThere(file, kLargestFile);
    if (!text) return 0;
    const ModelFile before = modelsFromText(*text);
    if (before.frame != frame) return 0;
    ModelFile left{frame, mergeFronts({}, before.fronts, removed).fronts};
    left.kinds = united(kinds, before.kinds);
    const std::size_t gone = before.fronts.size() - left.fronts.size();
    if (gone > 0) replaceFile(file, toText(left), lock);
    return gone;
  });
}

ModelFile readModelFile(const std::string& path) {
  return onFile(path, [&] { return modelsFromText(readOrdinaryFile(path, kLargestFile)); });
}

}  // namespace cabinet_articulation::core
