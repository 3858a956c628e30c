#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Watches until a door or a drawer was learned, asks where it will be, follows its handle, and saves what is known.

    python3 ask_kitchen.py FILE.yaml [NAMESPACE]
"""
import sys

import rospy
from geometry_msgs.msg import Point, PoseArray

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray
from cabinet_articulation.srv import Configuration, HandlePath, Predict, SaveModels

TYPES = {ArticulationModel.PRISMATIC: 'drawer', ArticulationModel.ROTATIONAL: 'door'}


def ask(name, service, **request):
    """The answer of a service. Each says itself why it has none."""
    rospy.wait_for_service(name, 10)
    answer = rospy.ServiceProxy(name, service)(**request)
    if not answer.success:
        sys.exit('%s: %s' % (name, answer.message))
    return answer


def wait_for_joint(namespace):
    """The first front whose joint is established, and the frame of its poses."""
    while not rospy.is_shutdown():
        models = rospy.wait_for_message(namespace + '/models', ArticulationModelArray)
        for model in models.models:
            rospy.loginfo('front %d: %s, type %d, %d observations', model.id, 'moved' if model.moved else 'at rest', model.type,
                          model.observations)
            if model.moved and model.support > 0 and model.type in TYPES:
                return model
    sys.exit(0)


def main(file, namespace='/cabinet'):
    joint = wait_for_joint(namespace)
    unit = 'm' if joint.type == ArticulationModel.PRISMATIC else 'rad'
    print('front %d is a %s, at %.2f %s' % (joint.id, TYPES[joint.type], joint.q, unit))

    # Where is it when it is half as far open as it was seen? And how far open is it there?
    half = ask(namespace + '/predict', Predict, id=joint.id, q=[joint.q_max / 2]).poses[0]
    back = ask(namespace + '/configuration', Configuration, id=joint.id, pose=half.pose)
    print('half open at q = %.3f %s, known to %.1f mm' % (back.q, unit, 1000 * half.covariance[0] ** 0.5))

    # The way of a hand that holds the front at its edge. A robot's arm would follow these poses; RViz shows them.
    path = ask(namespace + '/handle_path', HandlePath, id=joint.id, grasp_point=Point(joint.width / 2, 0, 0), q_from=0,
               q_to=joint.q_max, steps=20)
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
