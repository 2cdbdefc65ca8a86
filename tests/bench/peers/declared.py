"""Python's construct on declarations of the frames; CRCs are checked beside it, with tables.

declared.py FILE WORKLOAD SECONDS prints what was read and how long the fastest pass took, as JSON.
"""

import json
import sys
import time

from construct import Array, BitStruct, BitsInteger, Const, Flag, Int8ub, Int16ub, Int24ub, Int24ul, Padding, Struct


def table(polynomial, width):
    top, mask = 1 << (width - 1), (1 << width) - 1
    sums = []
    for byte in range(256):
        sum_ = byte << (width - 8)
        for _ in range(8):
            sum_ = (sum_ << 1 ^ (polynomial if sum_ & top else 0)) & mask
        sums.append(sum_)
    return sums


# A sum of six bits at the top of a byte.
CRC6, CRC8, CRC16 = table(0x03 << 2, 8), table(0x97, 8), table(0x8005, 16)


def crc8(data, crc_table):
    crc = 0
    for byte in data:
        crc = crc_table[crc ^ byte]
    return crc


PERIOD = Struct("turns" / Int16ub, "angle" / Int24ub, "status" / Int8ub, "crc" / Int8ub)
T485 = Struct(
    "control" / Const(0x1A, Int8ub),
    "status" / Int8ub,
    "angle" / Int24ul,
    "enid" / Int8ub,
    "turns" / Int24ul,
    "alarm" / Int8ub,
    "crc" / Int8ub,
)
ASI1 = BitStruct(
    Padding(1), "valid" / Flag, "zero_default" / Flag, Padding(2), "position21" / BitsInteger(3),
    Padding(1), "position18" / BitsInteger(7),
    Padding(1), "position11" / BitsInteger(7),
    Padding(1), "position4" / BitsInteger(5), "crc_high" / BitsInteger(2),
    Padding(1), "crc_middle" / BitsInteger(7),
    Padding(1), "crc_low" / BitsInteger(7),
)  # fmt: skip
BISS_C = BitStruct(
    Padding(6), "start" / Flag, "cds" / Flag,
    "turns" / BitsInteger(16), "angle" / BitsInteger(24),
    "no_error" / Flag, "no_warning" / Flag, "status" / BitsInteger(6), "crc" / BitsInteger(6),
    Padding(2),
)  # fmt: skip


def period_holds(data, frame):
    return crc8(data[:6], CRC8) == frame.crc


def t485_holds(data, frame):
    crc = 0
    for byte in data[:10]:
        crc ^= byte
    return crc == frame.crc


def asi1_holds(data, frame):
    crc = 0
    for byte, mask in zip(data, b"\xff\xff\xff\xfc\x80\x80"):
        crc = crc << 8 & 0xFFFF ^ CRC16[crc >> 8 ^ byte & mask]
    return crc == frame.crc_high << 14 | frame.crc_middle << 7 | frame.crc_low


def biss_c_holds(data, frame):
    return crc8(data[1:7], CRC6) >> 2 ^ 0x3F == frame.crc


def asi1_angle(frame):
    return frame.position21 << 19 | frame.position18 << 12 | frame.position11 << 5 | frame.position4


FORMATS = {
    "period": (PERIOD, period_holds, lambda frame: frame.angle),
    "t485": (T485, t485_holds, lambda frame: frame.angle),
    "asi1": (ASI1, asi1_holds, asi1_angle),
    "biss-c": (BISS_C, biss_c_holds, lambda frame: frame.angle),
}


def main():
    file, workload, least = sys.argv[1], sys.argv[2], float(sys.argv[3])
    declared, holds, angle = FORMATS[workload]
    with open(file, "rb") as opened:
        data = opened.read()
    length = declared.sizeof()
    frames = Array(len(data) // length, declared.compile())
    best, spent = float("inf"), 0.0
    while spent < least:
        start = time.perf_counter()
        read = frames.parse(data)
        for index, frame in enumerate(read):
            at = index * length
            if not holds(data[at : at + length], frame):
                raise SystemExit(f"wrong CRC in frame {index}")
        taken = time.perf_counter() - start
        best, spent = min(best, taken), spent + taken
    print(json.dumps({"frames": len(read), "angles": sum(map(angle, read)), "seconds": best}))


main()
