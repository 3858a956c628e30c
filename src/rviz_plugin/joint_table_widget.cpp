// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/joint_table_widget.h"

#include <QHeaderView>
#include <QProgressBar>
#include <cmath>

namespace cabinet_articulation {
namespace {

constexpr int kBarWidth = 70;  ///< [px]

}  // namespace

JointTableWidget::JointTableWidget(QWidget* parent) : QTableWidget(0, kColumns, parent) {
  setObjectName("joints");
  setHorizontalHeaderLabels({"Name", "Type", "Opening", "Range", "State"});
  setSelectionBehavior(SelectRows);
  setSelectionMode(SingleSelection);
  verticalHeader()->setToolTip("The front's id.");
  horizontalHeader()->setStretchLastSection(true);
  for (const Column column : {kName, kType, kRange})
    horizontalHeader()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  setColumnWidth(kOpening, kBarWidth);
  connect(this, &QTableWidget::itemChanged, this, &JointTableWidget::nameChanged);
}

void JointTableWidget::showRows(const std::vector<JointRow>& rows) {
  filling_ = true;
  // Both lists are ordered by id. Rows are taken out and put in one by one: Qt then keeps the selection and editor of the others.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    while (i < rows_.size() && rows_[i].id < rows[i].id) takeOut(i);
    if (i == rows_.size() || rows_[i].id != rows[i].id) putIn(i, rows[i]);
    rows_[i] = rows[i];
    showRow(static_cast<int>(i), rows[i]);
  }
  while (rows_.size() > rows.size()) takeOut(rows.size());
  filling_ = false;
}

void JointTableWidget::takeOut(std::size_t row) {
  // Qt would select a neighbour, which the next click on "Forget" would mean.
  if (currentRow() == static_cast<int>(row) || selectedId() == rows_[row].id) {
    clearSelection();
    setCurrentItem(nullptr);
  }
  rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(row));
  removeRow(static_cast<int>(row));
}

void JointTableWidget::putIn(std::size_t row, const JointRow& joint) {
  rows_.insert(rows_.begin() + static_cast<std::ptrdiff_t>(row), joint);
  insertRow(static_cast<int>(row));
}

void JointTableWidget::showRow(int row, const JointRow& joint) {
  auto* id = new QTableWidgetItem(QString::number(joint.id));
  setVerticalHeaderItem(row, id);
  setText(row, kName, joint.name);
  setText(row, kType, joint.type);
  setText(row, kRange, joint.range);
  setText(row, kState, joint.state);
  item(row, kType)->setToolTip(QString::fromStdString(joint.probabilities));
  item(row, kState)->setToolTip(item(row, kState)->text());
  QProgressBar* opening = bar(row);
  opening->setVisible(!joint.q.empty());
  opening->setValue(static_cast<int>(std::lround(100 * joint.opening)));
  opening->setFormat(QString::fromStdString(joint.q));
}

void JointTableWidget::setText(int row, Column column, const std::string& text) {
  QTableWidgetItem* cell = item(row, column);
  if (!cell) {
    cell = new QTableWidgetItem;
    if (column != kName) cell->setFlags(cell->flags() & ~Qt::ItemIsEditable);
    setItem(row, column, cell);
  }
  const bool edited = state() == EditingState && currentItem() == cell;
  if (!edited && cell->text() != QString::fromStdString(text)) cell->setText(QString::fromStdString(text));
}

QProgressBar* JointTableWidget::bar(int row) {
  auto* opening = qobject_cast<QProgressBar*>(cellWidget(row, kOpening));
  if (opening) return opening;
  opening = new QProgressBar;
  opening->setRange(0, 100);
  setCellWidget(row, kOpening, opening);
  return opening;
}

std::uint32_t JointTableWidget::selectedId() const {
  const QModelIndexList chosen = selectionModel()->selectedRows();
  if (chosen.isEmpty() || static_cast<std::size_t>(chosen.front().row()) >= rows_.size()) return 0;
  return rows_[static_cast<std::size_t>(chosen.front().row())].id;
}

void JointTableWidget::nameChanged(QTableWidgetItem* item) {
  if (filling_ || item->column() != kName || static_cast<std::size_t>(item->row()) >= rows_.size()) return;
  Q_EMIT renamed(rows_[static_cast<std::size_t>(item->row())].id, item->text());
}

}  // namespace cabinet_articulation
