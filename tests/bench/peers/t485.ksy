meta:
  id: t485
  title: Replies with all data of Tamagawa-compatible encoders
  license: MIT OR Apache-2.0
  endian: le
  bit-endian: le
seq:
  - id: frames
    type: frame
    repeat: eos
types:
  frame:
    seq:
      - id: control
        contents: [0x1a]
      - id: status
        type: u1
      - id: angle
        type: b24
      - id: enid
        type: u1
      - id: turns
        type: b24
      - id: alarm
        type: u1
      - id: crc
        type: u1
        doc: exclusive or of the bytes before
