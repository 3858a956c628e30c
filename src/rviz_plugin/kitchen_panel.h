// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <rviz/panel.h>

#include <QTimer>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "rviz_plugin/latest_message.h"
#include "rviz_plugin/pipeline_client.h"
#include "rviz_plugin/preview.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QLayout;
class QLineEdit;
class QSlider;

namespace cabinet_articulation {

class JointTableWidget;

/// The joints of one pipeline: to look at, to name, to try out and to keep. The objects have names, by which tests find them.
class KitchenPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit KitchenPanel(QWidget* parent = nullptr);
  ~KitchenPanel() override;

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  QLayout* makeTop();
  QLayout* makeTrial();
  QLayout* makeFile();
  QLayout* makeButtons();

  /// Empty in the field: that of `models`, as a launch file may have mapped it.
  std::string resolved(const std::string& name) const;
  void listen();
  void follow();
  void take(const ArticulationModelArray& message);
  void offerNamespaces(const std::vector<std::string>& found);
  void clear();
  const core::LearnedModel* selected() const;

  void selectionChanged();
  void tryOpening();
  void showPath();
  void rename(unsigned id, const QString& name);
  void saveModels();
  void loadModels();
  void exportUrdf();
  void forgetFront();
  void resetAll();

  /// Asks, and writes the answer's message below the table.
  template <class Service>
  void askAndTell(const std::string& service, const Service& call);
  void draw(const std::function<void()>& show);
  void tell(bool success, const std::string& message);

  ros::NodeHandle nh_;
  LatestMessage<ArticulationModelArray> input_;
  std::vector<core::LearnedModel> models_;
  std::unique_ptr<Preview> preview_;
  QTimer timer_;
  int rounds_ = 0;

  QComboBox* namespace_;
  QLabel *summary_, *predicted_, *answer_;
  JointTableWidget* table_;
  QSlider* slider_;
  QCheckBox* path_;
  QLineEdit* file_;
  PipelineClient client_;  ///< last: its answers use all of these
};

}  // namespace cabinet_articulation
