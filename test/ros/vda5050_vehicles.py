#!/usr/bin/env python3
"""Vehicles without hardware that speak VDA 5050 over MQTT, as strict as the standard lets them be.
One that is sent what it must refuse says so ("refused: ..."), as does the program when two are too
close ("too close: ...")."""

import argparse
import datetime
import itertools
import json
import math
import threading
import time

import paho.mqtt.client

from keeping_apart import tell_who_is_too_close

TICK = 0.02
STATE_PERIOD = 0.2
REACH = 0.3  # how far from its first node a vehicle takes an order up


class Vehicle:
    def __init__(self, serial, x, y, args):
        self.serial, self.x, self.y, self.speed = serial, x, y, args.speed
        self.order_id, self.update_id = "", 0
        self.last = {"nodeId": "", "sequenceId": 0}
        self.ahead = []
        self.errors = []
        self.since = 0.0
        self.news = True
        self.passed = 0
        self.cancelled = None

    def refuse(self, order, why):
        print("refused: %s, order %s update %d: %s" %
              (self.serial, order["orderId"], order["orderUpdateId"], why), flush=True)

    def take(self, order):
        nodes, edges = order["nodes"], order["edges"]
        numbers = [node["sequenceId"] for node in nodes]
        released = [node["released"] for node in nodes]
        if len(edges) != len(nodes) - 1 or not released[0] or \
                sorted(released, reverse=True) != released:
            return self.refuse(order, "it is malformed")
        if numbers != list(range(numbers[0], numbers[0] + 2 * len(nodes), 2)) or numbers[0] % 2:
            return self.refuse(order, "its numbers have gaps")
        if order["orderId"] == self.order_id:
            return self.update(order)
        place = nodes[0]["nodePosition"]
        if self.ahead:
            return self.refuse(order, "another order is under way")
        if math.hypot(place["x"] - self.x, place["y"] - self.y) > REACH or numbers[0] != 0:
            return self.refuse(order, "it begins elsewhere")
        self.order_id, self.update_id = order["orderId"], order["orderUpdateId"]
        self.last, self.ahead, self.since = nodes[0], nodes[1:], 0.0
        self.news = True

    def update(self, order):
        if order["orderUpdateId"] < self.update_id:
            return self.refuse(order, "it is an old one")
        if order["orderUpdateId"] == self.update_id:
            return None
        base = [node for node in self.ahead if node["released"]]
        end, first = (base or [self.last])[-1], order["nodes"][0]
        if any(end[key] != first[key] for key in ("nodeId", "sequenceId")):
            return self.refuse(order, "it does not begin with the last node of the base")
        self.update_id = order["orderUpdateId"]
        self.ahead = base + order["nodes"][1:]
        self.news = True
        return None

    def act(self, message):
        for action in message["actions"]:
            if action["actionType"] == "cancelOrder":
                self.ahead, self.news = [], True
                self.cancelled = time.monotonic()

    def may_drive(self):
        return bool(self.ahead) and self.ahead[0]["released"] and not self.errors

    def drive(self, seconds):
        left = self.speed * seconds
        while left > 0 and self.may_drive():
            place = self.ahead[0]["nodePosition"]
            dx, dy = place["x"] - self.x, place["y"] - self.y
            way = math.hypot(dx, dy)
            if way > left:
                self.x, self.y = self.x + dx * left / way, self.y + dy * left / way
                self.since += left
                return
            self.x, self.y, self.since = place["x"], place["y"], 0.0
            self.last = self.ahead.pop(0)
            self.passed += 1
            self.news = True
            left -= way

    def state(self, header):
        states = [{key: node[key] for key in ("nodeId", "sequenceId", "released")}
                  for node in self.ahead]
        return dict(header, orderId=self.order_id, orderUpdateId=self.update_id,
                    lastNodeId=self.last["nodeId"], lastNodeSequenceId=self.last["sequenceId"],
                    nodeStates=states, edgeStates=[], driving=self.may_drive(), actionStates=[],
                    batteryState={"batteryCharge": 80, "charging": False},
                    operatingMode="AUTOMATIC", errors=self.errors,
                    safetyState={"eStop": "NONE", "fieldViolation": False},
                    distanceSinceLastNode=self.since,
                    agvPosition={"positionInitialized": True, "x": self.x, "y": self.y,
                                 "theta": 0.0, "mapId": "map"})


class Vehicles:
    def __init__(self, args, starts):
        self.args = args
        self.vehicles = {serial: Vehicle(serial, x, y, args) for serial, (x, y) in starts.items()}
        self.lock = threading.Lock()
        self.counts = itertools.count()
        self.client = paho.mqtt.client.Client()
        self.client.username_pw_set(args.user, args.password)
        self.client.reconnect_delay_set(1, 1)
        self.client.on_connect = self.on_connect
        self.client.on_message = self.on_message
        self.client.connect_async("127.0.0.1", args.port, keepalive=5)
        self.client.loop_start()

    def topic(self, serial, name):
        return "/".join(("uagv", "v2", "ACME", serial, name))

    def header(self, serial):
        stamp = datetime.datetime.utcnow().strftime("%Y-%m-%dT%H:%M:%S.%f")[:-3] + "Z"
        return {"headerId": next(self.counts), "timestamp": stamp, "version": "2.0.0",
                "manufacturer": "ACME", "serialNumber": serial}

    def publish(self, serial, name, message, retain=False):
        self.client.publish(self.topic(serial, name), json.dumps(message), retain=retain)

    def on_connect(self, client, *_):
        client.subscribe([(self.topic("+", "order"), 0), (self.topic("+", "instantActions"), 0)])
        for serial in self.vehicles:
            self.publish(serial, "connection",
                         dict(self.header(serial), connectionState="ONLINE"), True)

    def on_message(self, _client, _data, message):
        serial, name = message.topic.split("/")[3:]
        with self.lock:
            if name == "order":
                self.vehicles[serial].take(json.loads(message.payload))
            else:
                self.vehicles[serial].act(json.loads(message.payload))

    def trouble(self, vehicle):
        """The error of a vehicle that was asked to have one: from its second node on until a while
        after it was told to drop its order."""
        if vehicle.serial != self.args.blocked or vehicle.passed < 2:
            return []
        if vehicle.cancelled is not None and time.monotonic() - vehicle.cancelled > 0.5:
            return []
        return [{"errorType": "pathBlocked", "errorLevel": "CRITICAL"}]

    def tick(self, seconds, all_of_them):
        with self.lock:
            for vehicle in self.vehicles.values():
                errors = self.trouble(vehicle)
                if errors != vehicle.errors:
                    vehicle.errors, vehicle.news = errors, True
                vehicle.drive(seconds)
                if vehicle.news or all_of_them:
                    self.publish(vehicle.serial, "state",
                                 vehicle.state(self.header(vehicle.serial)))
                    vehicle.news = False
            tell_who_is_too_close(self.vehicles, self.args.apart)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--user")
    parser.add_argument("--password")
    parser.add_argument("--starts", required=True, help="JSON: serial number to [x, y]")
    parser.add_argument("--speed", type=float, default=1.0)
    parser.add_argument("--apart", type=float, default=0.7)
    parser.add_argument("--blocked", help="serial number of one that is blocked for a while")
    args = parser.parse_args()
    with open(args.starts, encoding="ascii") as file:
        vehicles = Vehicles(args, json.load(file))
    last, told = time.monotonic(), 0.0
    while True:
        time.sleep(TICK)
        now = time.monotonic()
        all_of_them = now - told >= STATE_PERIOD
        told = now if all_of_them else told
        vehicles.tick(min(now - last, 3 * TICK), all_of_them)
        last = now


if __name__ == "__main__":
    main()
