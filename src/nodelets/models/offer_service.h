// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/SetName.h>
#include <ros/ros.h>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "cabinet_articulation/joints/known_fronts.h"
#include "ros/checks/callback_guard.h"

namespace cabinet_articulation {

/// A service whose response has `success` and `message`. `answer(request, &response)` throws what it refuses, with a reason in
/// words: that becomes the message, and the rest of the response stays empty. All other errors go to the guard.
template <class Service, class Answer>
ros::ServiceServer offerService(ros::NodeHandle* nh, const std::string& name, const CallbackGuard& guard, const Answer& answer) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> callback = [answer, name, guard](Request& request, Response& response) {
    response.message = "an error of the stage, see /diagnostics";
    guard(name, [&] {
      try {
        Response good;
        answer(static_cast<const Request&>(request), &good);
        response = std::move(good);
        response.success = true;
      } catch (const core::NameError& refusal) {
        response.message = refusal.what();
        if constexpr (std::is_same_v<Service, SetName>) response.proposal = refusal.proposal();
      } catch (const std::runtime_error& refusal) {
        response.message = refusal.what();
      } catch (const std::invalid_argument& refusal) {
        response.message = refusal.what();
      }
    });
    return true;
  };
  return nh->advertiseService<Request, Response>(name, callback);
}

}  // namespace cabinet_articulation
