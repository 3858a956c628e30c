#!/usr/bin/python3
"""Asks a running bridge as a program of the original release would, and says 'all is well' at the end."""
import math

import rospy
from articulation_msgs.msg import ModelMsg, TrackMsg
from articulation_msgs.srv import ArticulatedObjectSrv, GetModelPriorSrv, SetModelPriorSrv, TrackModelSrv
from geometry_msgs.msg import Point, Pose, Quaternion

from cabinet_articulation.msg import ArticulationModel, ArticulationModelArray, Track, TrackArray

POSES = 40


def door(q):
    """Turns about the y axis of the frame, 0.4 m away."""
    return Pose(Point(0.4 * math.cos(q), 0, -0.4 * math.sin(q)), Quaternion(0, math.sin(q / 2), 0, math.cos(q / 2)))


def track_of(pose_at, end):
    track = TrackMsg(pose=[pose_at(end * i / (POSES - 1)) for i in range(POSES)])
    track.header.frame_id = 'map'
    return track


def service(name, kind):
    rospy.wait_for_service(name, 20)
    return rospy.ServiceProxy(name, kind)


def value(model, name):
    return next(param.value for param in model.params if param.name == name)


def ask_about_models():
    request = ModelMsg(id=-1, track=track_of(door, 1.2))
    model = service('model_select', TrackModelSrv)(request).model
    assert model.name == 'rotational' and model.id == -1, model.name
    assert abs(value(model, 'rot_radius') - 0.4) < 0.002
    assert len(model.track.pose_projected) == POSES
    request.name = 'prismatic'
    assert service('model_fit', TrackModelSrv)(request).model.name == 'prismatic'
    better, worse = (service('model_eval', TrackModelSrv)(m).model for m in (model, service('model_fit', TrackModelSrv)(request).model))
    assert value(better, 'loglikelihood') > value(worse, 'loglikelihood') + 20
    stored = service('model_store', TrackModelSrv)(model).model
    assert stored.id == 0
    prior = service('model_prior_get', GetModelPriorSrv)().model
    assert [m.id for m in prior] == [0]
    service('model_prior_set', SetModelPriorSrv)([])
    assert not service('model_prior_get', GetModelPriorSrv)().model
    request.track.pose = []
    try:
        service('model_select', TrackModelSrv)(request)
    except rospy.ServiceException:
        pass
    else:
        raise AssertionError('a track without poses has no model')


def ask_about_an_object():
    ask = service('get_spanning_tree', ArticulatedObjectSrv)
    request = ArticulatedObjectSrv._request_class()
    request.object.parts = [track_of(door, 0), track_of(door, 1.2)]
    models = ask(request).object.models
    assert [(m.id, m.name) for m in models] == [(1, 'rotational')], models


def publish_until(done, messages):
    end = rospy.get_time() + 20
    while not done():
        assert rospy.get_time() < end, 'no answer'
        for publisher, message in messages:
            publisher.publish(message)
        rospy.sleep(0.2)


def watch_the_pipeline():
    seen = {}

    def take(message):
        seen[type(message)] = message

    subscribers = [rospy.Subscriber('track', TrackMsg, take), rospy.Subscriber('model', ModelMsg, take)]
    tracks, models = (rospy.Publisher(name, kind, queue_size=1) for name, kind in (('tracks', TrackArray), ('models', ArticulationModelArray)))
    track = Track(id=7, stamps=[rospy.Time(100 + i) for i in range(POSES)], poses=track_of(door, 1.2).pose, width=0.8, height=0.6)
    model = ArticulationModel(id=7, type=ArticulationModel.ROTATIONAL, moved=True, explained=True, observed=True, q_max=1.2,
                              radius=0.4, width=0.8, height=0.6)
    model.origin.position.x = 0.4
    model.origin.orientation.w = 1
    model.axis.y = 1
    messages = (TrackArray(tracks=[track]), ArticulationModelArray(models=[model]))
    for message in messages:
        message.header.stamp, message.header.frame_id = rospy.Time(140), 'map'
    publish_until(lambda: len(seen) == 2, list(zip((tracks, models), messages)))
    del subscribers
    # The corner that the poses are of lies on the hinge, 0.3 m below the centre.
    corner = seen[TrackMsg].pose[0].position
    assert abs(corner.x) < 1e-6 and abs(corner.y + 0.3) < 1e-6, corner
    model = seen[ModelMsg]
    assert (model.id, model.name, model.header.frame_id) == (7, 'rotational', 'map')
    assert value(model, 'avg_error_position') < 1e-6 and value(model, 'rot_radius') < 1e-6
    assert abs(value(model, 'rot_center.y') + 0.3) < 1e-6


def track_for_the_pipeline():
    """What a tracker of the original release sees is learned."""
    models = []
    subscriber = rospy.Subscriber('/foreign/model', ModelMsg, models.append)
    publisher = rospy.Publisher('/foreign/track', TrackMsg, queue_size=1)
    track = track_of(door, 1.2)
    track.id = 5
    publish_until(lambda: models, [(publisher, track)])
    del subscriber
    model = models[0]
    assert (model.id, model.name, len(model.track.pose)) == (5, 'rotational', POSES)


rospy.init_node('ask_bridge')
ask_about_models()
ask_about_an_object()
watch_the_pipeline()
track_for_the_pipeline()
print('all is well')
