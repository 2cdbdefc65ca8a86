meta:
  id: period
  title: What MPP and PT encoders send every millisecond
  license: MIT OR Apache-2.0
  endian: be
seq:
  - id: frames
    type: frame
    repeat: eos
types:
  frame:
    seq:
      - id: turns
        type: u2
      - id: angle
        type: b24
      - id: error
        type: b1
      - id: warning
        type: b1
      - id: status
        type: b6
      - id: crc
        type: u1
        doc: CRC-8/0x97 over the bytes before
