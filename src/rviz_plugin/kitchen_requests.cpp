// SPDX-License-Identifier: BSD-3-Clause
// What the panel asks the pipeline for.
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/SetName.h>
#include <std_srvs/Trigger.h>

#include <QCheckBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QSaveFile>
#include <QSignalBlocker>
#include <QSlider>
#include <QXmlStreamReader>
#include <cmath>
#include <stdexcept>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "rviz_plugin/joint_drawing.h"
#include "rviz_plugin/joint_table_widget.h"
#include "rviz_plugin/kitchen_panel.h"

namespace cabinet_articulation {
namespace {

constexpr std::uint32_t kPathSteps = 40;  ///< enough for a curve to look round

/// Models are saved under names of the same field: their file must not be lost to a click on the wrong button.
bool holdsOtherThanUrdf(const QString& path) {
  QFile file(path);
  if (!file.exists()) return false;
  if (!file.open(QIODevice::ReadOnly)) return true;
  if (file.size() == 0) return false;
  QXmlStreamReader document(&file);
  return !document.readNextStartElement() || document.name() != QLatin1String("robot");
}

}  // namespace

template <class Service>
void KitchenPanel::askAndTell(const std::string& service, const Service& call) {
  client_.ask(service, resolved(service), call,
              [this](const Service& answer) { tell(answer.response.success, answer.response.message); });
}

void KitchenPanel::draw(const std::function<void()>& show) {
  try {
    show();
  } catch (const std::invalid_argument& error) {
    tell(false, std::string("the answer cannot be drawn: ") + error.what());
  }
}

void KitchenPanel::selectionChanged() {
  const core::LearnedModel* model = selected();
  const bool joint = model && isJoint(*model);
  slider_->setEnabled(joint);
  path_->setEnabled(joint);
  predicted_->clear();
  preview_->clear();
  if (!joint) return;
  const QSignalBlocker silent(slider_);
  const double range = model->q_max - model->q_min;
  slider_->setValue(range > 0 ? static_cast<int>(std::lround(slider_->maximum() * (model->q - model->q_min) / range)) : 0);
  showPath();
}

void KitchenPanel::tryOpening() {
  const core::LearnedModel* model = selected();
  if (!model || !isJoint(*model)) return;
  Predict call;
  call.request.id = model->id;
  call.request.q = {model->q_min + (model->q_max - model->q_min) * slider_->value() / slider_->maximum()};
  predicted_->setText(QString::fromStdString(configurationText(*model, call.request.q.front())));
  client_.ask("predict", resolved("predict"), call, [this, model = *model](const Predict& answer) {
    if (table_->selectedId() != model.id) return;
    if (!answer.response.success || answer.response.poses.empty()) return tell(false, answer.response.message);
    draw([&] { preview_->showFront(answer.response.header, model, answer.response.poses.front()); });
  });
}

void KitchenPanel::showPath() {
  const core::LearnedModel* model = selected();
  if (!model || !isJoint(*model)) return;
  if (!path_->isChecked()) return preview_->hidePath();
  HandlePath call;
  call.request.id = model->id;
  call.request.grasp_point = toPoint(graspPoint(*model));
  call.request.q_from = model->q_min;
  call.request.q_to = model->q_max;
  call.request.steps = kPathSteps;
  client_.ask("handle_path", resolved("handle_path"), call, [this, id = model->id](const HandlePath& answer) {
    if (table_->selectedId() != id || !path_->isChecked()) return;
    if (!answer.response.success) return tell(false, answer.response.message);
    draw([&] { preview_->showPath(answer.response.header, answer.response.poses); });
  });
}

void KitchenPanel::rename(unsigned id, const QString& name) {
  SetName call;
  call.request.id = id;
  call.request.name = name.trimmed().toStdString();
  client_.ask("set_name " + std::to_string(id), resolved("set_name"), call, [this](const SetName& answer) {
    tell(answer.response.success, answer.response.message);
    for (core::LearnedModel& model : models_)
      if (answer.response.success && model.id == answer.request.id) model.name = answer.request.name;
    table_->showRows(jointRows(models_));
  });
}

void KitchenPanel::saveModels() {
  SaveModels call;
  call.request.file = file_->text().trimmed().toStdString();
  askAndTell("save_models", call);
}

void KitchenPanel::loadModels() {
  LoadModels call;
  call.request.file = file_->text().trimmed().toStdString();
  askAndTell("load_models", call);
}

void KitchenPanel::exportUrdf() {
  const QString path = file_->text().trimmed();
  if (path.isEmpty()) return tell(false, "name the file of this computer that the URDF goes to");
  if (holdsOtherThanUrdf(path))
    return tell(false,
                ("'" + path + "' is there and is no robot description; it is left as it is: name another file").toStdString());
  client_.ask("export_urdf", resolved("export_urdf"), ExportUrdf(), [this, path](const ExportUrdf& answer) {
    if (!answer.response.success) return tell(false, answer.response.message);
    QSaveFile file(path);
    const QByteArray text = QByteArray::fromStdString(answer.response.urdf);
    const bool written = file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit();
    tell(written, (written ? "URDF written to '" + path + "'" : "'" + path + "': " + file.errorString()).toStdString());
  });
}

void KitchenPanel::forgetFront() {
  Forget call;
  call.request.id = table_->selectedId();
  if (call.request.id == 0) return tell(false, "select the front to be forgotten");
  askAndTell("forget", call);
}

void KitchenPanel::resetAll() { askAndTell("reset", std_srvs::Trigger()); }

}  // namespace cabinet_articulation
