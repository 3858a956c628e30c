// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QTableWidget>
#include <cstdint>
#include <string>
#include <vector>

#include "rviz_plugin/joint_table.h"

class QProgressBar;

namespace cabinet_articulation {

/// The fronts as a table. Rows that stay keep the selection and a name that is being edited.
class JointTableWidget : public QTableWidget {
  Q_OBJECT

 public:
  enum Column { kName, kType, kOpening, kRange, kState, kColumns };

  explicit JointTableWidget(QWidget* parent = nullptr);

  /// Ordered by id.
  void showRows(const std::vector<JointRow>& rows);

  /// 0: nobody.
  std::uint32_t selectedId() const;

 Q_SIGNALS:
  /// A person changed a name.
  void renamed(unsigned id, const QString& name);

 private:
  void takeOut(std::size_t row);
  void putIn(std::size_t row, const JointRow& joint);
  void showRow(int row, const JointRow& joint);
  void setText(int row, Column column, const std::string& text);
  QProgressBar* bar(int row);
  void nameChanged(QTableWidgetItem* item);

  std::vector<JointRow> rows_;
  bool filling_ = false;
};

}  // namespace cabinet_articulation
