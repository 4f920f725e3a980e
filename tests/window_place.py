#!/usr/bin/python3
"""Prints where a control lies on the screen, as programs that read screens find it.

    window_place.py NAME [--at SHARE] [--wait SECONDS]
    window_place.py NAME --text

NAME is a regular expression for the whole name of the control. Its place, `X Y`, is SHARE of the way from its left to
its right side, by default the middle. With --text it is the control's name, or the text that is typed into it. Without
such a control on the screen within SECONDS (default 10) that ends with 1, and all names that there are go to standard
error. It needs PyGObject (apt: python3-gi) and the bus of at-spi2-core.
"""
import argparse
import re
import sys
import time

from gi.repository import Gio, GLib

ACCESSIBLE = "org.a11y.atspi.Accessible"
ROOT = "/org/a11y/atspi/accessible/root"


def call(bus, at, interface, method, arguments=None):
    reply = bus.call_sync(at[0], at[1], interface, method, arguments, None, Gio.DBusCallFlags.NONE, 5000, None)
    return reply.unpack()


def children(bus, at):
    try:
        return [tuple(child) for child in call(bus, at, ACCESSIBLE, "GetChildren")[0]]
    except GLib.Error:
        return []


def name_of(bus, at):
    asked = GLib.Variant("(ss)", (ACCESSIBLE, "Name"))
    return call(bus, at, "org.freedesktop.DBus.Properties", "Get", asked)[0]


def controls(bus):
    """Every control of every program: its name, its rectangle on the screen, and its address."""
    waiting = children(bus, ("org.a11y.atspi.Registry", ROOT))
    while waiting:
        at = waiting.pop()
        waiting.extend(children(bus, at))
        try:
            extents = call(bus, at, "org.a11y.atspi.Component", "GetExtents", GLib.Variant("(u)", (0,)))[0]
            yield name_of(bus, at), extents, at
        except GLib.Error:
            pass


def text_of(bus, at, name):
    try:
        return call(bus, at, "org.a11y.atspi.Text", "GetText", GLib.Variant("(ii)", (0, -1)))[0]
    except GLib.Error:
        return name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("--text", action="store_true")
    parser.add_argument("--at", type=float, default=0.5)
    parser.add_argument("--wait", type=float, default=10.0)
    asked = parser.parse_args()
    session = Gio.bus_get_sync(Gio.BusType.SESSION)
    address = call(session, ("org.a11y.Bus", "/org/a11y/bus"), "org.a11y.Bus", "GetAddress")[0]
    flags = Gio.DBusConnectionFlags.AUTHENTICATION_CLIENT | Gio.DBusConnectionFlags.MESSAGE_BUS_CONNECTION
    bus = Gio.DBusConnection.new_for_address_sync(address, flags)
    end = time.monotonic() + asked.wait
    while True:
        found = list(controls(bus))
        for name, (x, y, width, height), at in found:
            if re.fullmatch(asked.name, name) and width > 0 and height > 0:
                if asked.text:
                    print(text_of(bus, at, name))
                    return 0
                print(round(x + width * asked.at), round(y + height / 2))
                return 0
        if time.monotonic() > end:
            names = ", ".join(sorted({repr(name) for name, *_ in found}))
            print(f"there is no {asked.name!r} on the screen, but {names}", file=sys.stderr)
            return 1
        time.sleep(0.2)


sys.exit(main())
