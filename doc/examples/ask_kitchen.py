#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Watches until a door or a drawer was learned, asks where it will be, follows its handle, and saves what is known.

    python3 ask_kitchen.py FILE.yaml [NAMESPACE]
"""
import math
import sys
import time

import rospy
from geometry_msgs.msg import Point, PoseArray

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray
from cabinet_articulation.srv import Configuration, HandlePath, Predict, SaveModels

TYPES = {ArticulationModel.PRISMATIC: 'drawer', ArticulationModel.ROTATIONAL: 'door'}
PATIENCE = 60  # [s] without any message: then nothing runs, or the camera sends nothing


def ask(name, service, **request):
    """The answer of a service. Each says itself why it has none."""
    rospy.wait_for_service(name, 10)
    answer = rospy.ServiceProxy(name, service)(**request)
    if not answer.success:
        sys.exit('%s: %s' % (name, answer.message))
    return answer


def wait_for_joint(namespace):
    """The first front whose joint is established, and the frame of its poses."""
    joints, said, heard = [], {}, [time.monotonic()]

    def look(message):
        heard[0] = time.monotonic()
        for model in message.models:
            state = 'front %d: %s, type %d' % (model.id, 'moved' if model.moved else 'at rest', model.type)
            if said.get(model.id) != state:
                rospy.loginfo(state)
                said[model.id] = state
            if not joints and model.moved and model.support > 0 and model.type in TYPES:
                joints.append(model)

    subscriber = rospy.Subscriber(namespace + '/models', ArticulationModelArray, look)
    while not joints:
        if rospy.is_shutdown():
            sys.exit(0)
        if time.monotonic() - heard[0] > PATIENCE:
            sys.exit('nothing came on %s/models for %d s: does the pipeline run, and do its images come?' % (namespace, PATIENCE))
        time.sleep(0.1)
    subscriber.unregister()
    return joints[0]


def far_edge(joint):
    """The middle of the edge farthest from the hinge, in the front's frame; of a drawer, which has none, the right edge."""
    if joint.type == ArticulationModel.PRISMATIC:
        return Point(joint.width / 2, 0, 0)
    center, hinge, o = joint.origin.position, joint.axis_point, joint.origin.orientation
    to_hinge = (hinge.x - center.x, hinge.y - center.y, hinge.z - center.z)
    # Along the front's width and height: the first two columns of the rotation matrix of its orientation.
    x = dot(to_hinge, (1 - 2 * (o.y * o.y + o.z * o.z), 2 * (o.x * o.y + o.w * o.z), 2 * (o.x * o.z - o.w * o.y)))
    y = dot(to_hinge, (2 * (o.x * o.y - o.w * o.z), 1 - 2 * (o.x * o.x + o.z * o.z), 2 * (o.y * o.z + o.w * o.x)))
    if abs(x) * joint.height >= abs(y) * joint.width:  # it hangs at the left or the right
        return Point(-math.copysign(joint.width / 2, x), 0, 0)
    return Point(0, -math.copysign(joint.height / 2, y), 0)


def dot(a, b):
    return sum(one * other for one, other in zip(a, b))


def main(file, namespace='/cabinet'):
    joint = wait_for_joint(namespace)
    unit = 'm' if joint.type == ArticulationModel.PRISMATIC else 'rad'
    print('front %d is a %s, at %.2f %s' % (joint.id, TYPES[joint.type], joint.q, unit))

    # Where is it in the middle of the way that was seen? q = 0 is merely where it was seen first. And what is q there?
    half = ask(namespace + '/predict', Predict, id=joint.id, q=[(joint.q_min + joint.q_max) / 2]).poses[0]
    back = ask(namespace + '/configuration', Configuration, id=joint.id, pose=half.pose)
    print('half way at q = %.3f %s, known to %.1f mm' % (back.q, unit, 1000 * half.covariance[0] ** 0.5))

    # The way of a hand that holds the front at the edge that moves most. A robot's arm would follow these poses; RViz shows them.
    path = ask(namespace + '/handle_path', HandlePath, id=joint.id, grasp_point=far_edge(joint),
               q_from=joint.q_min, q_to=joint.q_max, steps=20)
    publisher = rospy.Publisher('gripper_path', PoseArray, queue_size=1, latch=True)
    publisher.publish(PoseArray(path.header, [pose.pose for pose in path.poses]))
    for q, pose in zip(path.q, path.poses):
        hand = pose.pose.position
        print('q = %.3f: hand at %.3f %.3f %.3f' % (q, hand.x, hand.y, hand.z))

    print('saved: ' + ask(namespace + '/save_models', SaveModels, file=file).message)
    rospy.spin()  # the path stays published until Ctrl-C


if __name__ == '__main__':
    rospy.init_node('ask_kitchen', anonymous=True)
    arguments = rospy.myargv()[1:]
    if not 1 <= len(arguments) <= 2:
        sys.exit(__doc__)
    main(*arguments)
