meta:
  id: biss_c
  title: BiSS-C with 24 bits per turn and 16 bits of turns, captured over SPI
  license: MIT OR Apache-2.0
  bit-endian: be
seq:
  - id: frames
    type: frame
    repeat: eos
types:
  frame:
    seq:
      - id: idle
        type: b1
      - id: ack
        type: b5
      - id: start
        type: b1
      - id: cds
        type: b1
      - id: turns
        type: b16
      - id: angle
        type: b24
      - id: no_error
        type: b1
      - id: no_warning
        type: b1
      - id: status
        type: b6
      - id: crc
        type: b6
        doc: CRC-6/0x03, inverted, over turns to status
      - id: tail
        type: b2
