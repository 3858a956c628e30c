// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/kitchen_panel.h"

#include <rviz/visualization_manager.h>

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/conversions.h"
#include "rviz_plugin/confirmed_button.h"
#include "rviz_plugin/joint_table_widget.h"

namespace cabinet_articulation {
namespace {

constexpr int kPeriod = 200;          ///< [ms] ours: a front that is gone disappears at once, as people see it
constexpr int kRoundsPerSearch = 25;  ///< namespaces are looked for every five seconds
constexpr int kTableHeight = 130;     ///< [px] four joints

template <class Widget>
Widget* named(const char* name, Widget* widget) {
  widget->setObjectName(name);
  return widget;
}

template <class Clicked>
QPushButton* makeButton(const char* name, const QString& text, const QString& help, Clicked clicked) {
  auto* button = named(name, new QPushButton(text));
  button->setToolTip(help);
  QObject::connect(button, &QPushButton::clicked, button, clicked);
  return button;
}

}  // namespace

KitchenPanel::KitchenPanel(QWidget* parent)
    : Panel(parent),
      namespace_(named("namespace", new QComboBox)),
      summary_(named("summary", new QLabel)),
      predicted_(named("predicted", new QLabel)),
      answer_(named("answer", new QLabel)),
      table_(new JointTableWidget),
      slider_(named("slider", new QSlider(Qt::Horizontal))),
      path_(named("path", new QCheckBox("Handle path"))),
      file_(named("file", new QLineEdit)) {
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(makeTop());
  summary_->setWordWrap(true);
  layout->addWidget(summary_);
  table_->setMinimumHeight(kTableHeight);
  layout->addWidget(table_);
  layout->addLayout(makeTrial());
  layout->addLayout(makeFile());
  layout->addLayout(makeButtons());
  answer_->setWordWrap(true);
  layout->addWidget(answer_);
  connect(table_, &QTableWidget::itemSelectionChanged, this, &KitchenPanel::selectionChanged);
  connect(table_, &JointTableWidget::renamed, this, &KitchenPanel::rename);
  connect(&timer_, &QTimer::timeout, this, &KitchenPanel::follow);
  preview_ = std::make_unique<Preview>(nullptr);
  selectionChanged();
  listen();
  timer_.start(kPeriod);
}

KitchenPanel::~KitchenPanel() { input_.shutdown(); }

void KitchenPanel::onInitialize() { preview_ = std::make_unique<Preview>(vis_manager_); }

QLayout* KitchenPanel::makeTop() {
  auto* row = new QHBoxLayout;
  namespace_->setEditable(true);
  namespace_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  namespace_->setToolTip("The pipeline's namespace; empty: that of the topic 'models', as the launch file maps it.");
  const bool mapped = ros::names::resolve("models") != "/models";
  namespace_->setCurrentText(mapped ? "" : "cabinet");
  connect(namespace_, &QComboBox::currentTextChanged, this, [this] {
    listen();
    Q_EMIT configChanged();
  });
  row->addWidget(new QLabel("Namespace"));
  row->addWidget(namespace_);
  return row;
}

QLayout* KitchenPanel::makeTrial() {
  auto* row = new QHBoxLayout;
  slider_->setRange(0, 1000);
  slider_->setToolTip("Where the selected front would be.");
  path_->setToolTip("The way of a hand that holds the selected front at the edge far from its axis.");
  connect(slider_, &QSlider::valueChanged, this, &KitchenPanel::tryOpening);
  connect(path_, &QCheckBox::toggled, this, &KitchenPanel::showPath);
  row->addWidget(new QLabel("Try"));
  row->addWidget(slider_);
  row->addWidget(predicted_);
  row->addWidget(path_);
  return row;
}

QLayout* KitchenPanel::makeFile() {
  auto* row = new QHBoxLayout;
  file_->setPlaceholderText("the pipeline's models_file");
  file_->setToolTip("Save and Load: a file on the computer of the pipeline. URDF: one on this computer.");
  connect(file_, &QLineEdit::editingFinished, this, &KitchenPanel::configChanged);
  row->addWidget(new QLabel("File"));
  row->addWidget(file_);
  row->addWidget(makeButton("browse", "...", "Choose a file", [this] {
    const QString chosen =
        QFileDialog::getSaveFileName(this, "File", file_->text(), "", nullptr, QFileDialog::DontConfirmOverwrite);
    if (!chosen.isEmpty()) file_->setText(chosen);
  }));
  return row;
}

QLayout* KitchenPanel::makeButtons() {
  auto* row = new QHBoxLayout;
  row->addWidget(makeButton("save", "Save", "Merge what was learned into the file", [this] { saveModels(); }));
  row->addWidget(makeButton("load", "Load", "Forget everything and know what the file says", [this] { loadModels(); }));
  row->addWidget(makeButton("urdf", "URDF", "Write all joints as a robot description", [this] { exportUrdf(); }));
  row->addWidget(named("forget", new ConfirmedButton("Forget", [this] { forgetFront(); })));
  row->addWidget(named("reset", new ConfirmedButton("Reset", [this] { resetAll(); })));
  return row;
}

std::string KitchenPanel::resolved(const std::string& name) const {
  std::string field = namespace_->currentText().trimmed().toStdString();
  std::string why;
  if (!ros::names::validate(field, why)) field.clear();
  const std::string models = ros::names::resolve(field.empty() ? "models" : ros::names::append(field, "models"));
  return ros::names::append(ros::names::parentNamespace(models), name);
}

void KitchenPanel::listen() {
  clear();
  input_.subscribe(nh_, resolved("models"), [this](const auto& message) { take(message); });
}

void KitchenPanel::take(const ArticulationModelArray& message) {
  std::string left_out;
  models_ = usableModels(message, &left_out);
  summary_->setText(QString::fromStdString(summaryOf(models_)));
  table_->showRows(jointRows(models_));
  if (!left_out.empty()) tell(false, left_out);
}

void KitchenPanel::clear() {
  models_.clear();
  table_->showRows({});
  preview_->clear();
}

void KitchenPanel::follow() {
  const bool gone = input_.isStale(kSilence);
  if (gone && !models_.empty()) clear();
  if (gone || input_.count() == 0) summary_->setText(QString::fromStdString(input_.whatIsMissing()));
  preview_->follow();
  if (rounds_++ % kRoundsPerSearch != 0) return;
  client_.findNamespaces([this](const std::vector<std::string>& found) { offerNamespaces(found); });
}

void KitchenPanel::offerNamespaces(const std::vector<std::string>& found) {
  // A box that was empty would choose what is put in.
  const QString chosen = namespace_->currentText();
  const QSignalBlocker silent(namespace_);
  for (const std::string& name : found)
    if (namespace_->findText(QString::fromStdString(name)) < 0) namespace_->addItem(QString::fromStdString(name));
  namespace_->setEditText(chosen);
}

const core::LearnedModel* KitchenPanel::selected() const {
  const std::uint32_t id = table_->selectedId();
  const auto model = std::find_if(models_.begin(), models_.end(), [id](const auto& other) { return other.id == id; });
  return model == models_.end() ? nullptr : &*model;
}

void KitchenPanel::load(const rviz::Config& config) {
  Panel::load(config);
  QString text;
  if (config.mapGetString("Namespace", &text)) namespace_->setCurrentText(text);
  if (config.mapGetString("File", &text)) file_->setText(text);
}

void KitchenPanel::save(rviz::Config config) const {
  Panel::save(config);
  config.mapSetValue("Namespace", namespace_->currentText());
  config.mapSetValue("File", file_->text());
}

void KitchenPanel::tell(bool success, const std::string& message) {
  answer_->setStyleSheet(success ? "" : "color: #d55e00");
  answer_->setText(QString::fromStdString(message));
}

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::KitchenPanel, rviz::Panel)
