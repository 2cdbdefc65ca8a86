meta:
  id: asi1
  title: Binary stream of IncOder and IP-75 encoders
  license: MIT OR Apache-2.0
  bit-endian: be
seq:
  - id: frames
    type: frame
    repeat: eos
types:
  frame:
    seq:
      - id: marker0
        type: b1
      - id: valid
        type: b1
      - id: zero_default
        type: b1
      - id: zeros
        type: b2
      - id: position21
        type: b3
      - id: marker1
        type: b1
      - id: position18
        type: b7
      - id: marker2
        type: b1
      - id: position11
        type: b7
      - id: marker3
        type: b1
      - id: position4
        type: b5
      - id: crc_high
        type: b2
        doc: CRC-16/0x8005 over the bytes with its own bits as 0
      - id: marker4
        type: b1
      - id: crc_middle
        type: b7
      - id: marker5
        type: b1
      - id: crc_low
        type: b7
    instances:
      angle:
        value: (position21 << 19) | (position18 << 12) | (position11 << 5) | position4
