// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPushButton>
#include <QTimer>
#include <functional>

namespace cabinet_articulation {

/// A button for what cannot be undone: the first click asks, the second within three seconds does it.
class ConfirmedButton : public QPushButton {
 public:
  ConfirmedButton(const QString& text, const std::function<void()>& confirmed) : QPushButton(text) {
    timer_.setSingleShot(true);
    timer_.setInterval(kMilliseconds);
    connect(&timer_, &QTimer::timeout, this, [this, text] { setText(text); });
    connect(this, &QPushButton::clicked, this, [this, text, confirmed] {
      const bool asked = timer_.isActive();
      setText(asked ? text : "Really " + text.toLower() + "?");
      if (!asked) return timer_.start();
      timer_.stop();
      confirmed();
    });
  }

 private:
  static constexpr int kMilliseconds = 3000;

  QTimer timer_;
};

}  // namespace cabinet_articulation
