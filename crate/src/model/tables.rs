//! The tables of the order codes: what stands at each position, and what it means.

use super::{
    Turns,
    form::{Form, Part, Place, Says, Word},
};
use crate::{
    format::said,
    language::msg,
    product::{Interface, Series},
};

/// What only a composer needs.
const fn shown(texts: &'static [&'static str]) -> &'static [&'static str] {
    if cfg!(feature = "small") { &[] } else { texts }
}

const fn word(text: &'static str, says: Says, doc: &'static str) -> Word {
    Word {
        text,
        says,
        doc: said(doc),
    }
}

impl Part {
    const fn of(place: Place, words: &'static [Word], doc: &'static str) -> Self {
        Self {
            place,
            doc: said(doc),
            number: None,
            words,
            missing: None,
        }
    }

    const fn counted(self, least: u32, most: u32, unit: &'static str) -> Self {
        Self {
            number: Some((least, most, unit)),
            ..self
        }
    }

    const fn or(self, missing: &'static str) -> Self {
        Self {
            missing: Some(missing),
            ..self
        }
    }
}

/// Bits per turn, and how turns are kept (MPP and PT, "Models"; the 8-bit counter: "BUS", example).
static RESOLUTION: Part = Part::of(
    Place::Resolution,
    &[
        word("", Says::Turns(Turns::Single, 0), msg("single turn")),
        word(
            "M",
            Says::Turns(Turns::Powered, 16),
            msg("turns are counted while there is power"),
        ),
        word(
            "BM",
            Says::Turns(Turns::Battery, 16),
            msg("turns are counted on a battery while there is no power"),
        ),
        word(
            "FM",
            Says::Turns(Turns::Flash, 16),
            msg("turns are kept in flash; without power the shaft may turn by 90° at most"),
        ),
        word(
            "M1",
            Says::Turns(Turns::Powered, 8),
            msg("an 8-bit turn counter, while there is power"),
        ),
    ],
    msg("bits per turn, and how turns are kept"),
)
.counted(16, 24, msg("bits"));

/// The wires and what is spoken over them (MPP and PT, "Models").
const INTERFACE: Part = Part::of(
    Place::Interface,
    &[
        word(
            "S",
            Says::Interface(Interface::Ssi),
            msg("SSI; it has no CRC, so the manual recommends BiSS-C on the same wires"),
        ),
        word("B", Says::Interface(Interface::BissC), "BiSS-C"),
        word(
            "R",
            Says::Interface(Interface::Rs485),
            msg("RS485, two wires"),
        ),
        word(
            "A",
            Says::Interface(Interface::Rs422),
            msg("RS422, four wires"),
        ),
        word(
            "T",
            Says::Interface(Interface::T485),
            msg("T485, compatible with Tamagawa of 17 or 23 bits"),
        ),
        word(
            "D",
            Says::Interface(Interface::Bus),
            msg("BUS, the high-speed bus"),
        ),
        word(
            "P",
            Says::Interface(Interface::Period),
            msg("PERIOD, sends by itself every millisecond"),
        ),
    ],
    msg("interface"),
);

static OUTPUT: Part = Part::of(
    Place::Output,
    &[word("A", Says::Nothing, msg("absolute value"))],
    msg("what is put out"),
);

static SUPPLY: Part = Part::of(
    Place::Supply,
    &[word("N", Says::Nothing, msg("5 V"))],
    msg("supply"),
);

static TEMPERATURE: Part = Part::of(
    Place::Temperature,
    &[
        word("A", Says::Temperature(-40, 85), msg("−40…85 °C")),
        word("B", Says::Temperature(-40, 105), msg("−40…105 °C")),
        word("C", Says::Temperature(-40, 125), msg("−40…125 °C")),
    ],
    msg("working temperature"),
);

/// Baud codes A and B (MPP and PT, "RS485/RS422").
static OPTION: Part = Part::of(
    Place::Option,
    &[
        word("M", Says::Nothing, msg("no option")),
        word("A", Says::Baud(115_200), msg("115 200 baud")),
        word(
            "B",
            Says::Baud(2_500_000),
            msg("2 500 000 baud, as without a code"),
        ),
    ],
    msg("none, or the baud rate of RS485 and RS422"),
);

const fn diameter(place: Place, words: &'static [Word], doc: &'static str) -> Part {
    Part::of(place, words, doc).counted(1, 999, msg("mm"))
}

/// All forms of order codes.
pub static FORMS: &[Form] = &[
    Form {
        title: "MPP",
        source: said("MPP, order code"),
        example: shown(&["MPP", "40", "60", "A", "24BM", "R", "N", "A", "M"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word(
                    "MPP",
                    Says::Series(Series::Mpp),
                    msg("KingKong MPP, magnetic"),
                )],
                msg("series"),
            ),
            &diameter(
                Place::Rotor,
                &[word("", Says::Nothing, "")],
                msg("inner diameter of the rotor"),
            ),
            &diameter(
                Place::Stator,
                &[word("", Says::Nothing, "")],
                msg("outer diameter of the stator"),
            ),
            &OUTPUT,
            &RESOLUTION,
            &INTERFACE,
            &SUPPLY,
            &TEMPERATURE,
            &OPTION,
        ],
    },
    Form {
        title: "PT",
        source: said("PT, models and size table; the letters as in MPP, order code"),
        example: shown(&["PT", "20", "30", "A", "24BM", "R", "N", "A", "M"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word(
                    "PT",
                    Says::Series(Series::Pt),
                    msg("Mosrac PT, magnetic"),
                )],
                msg("series"),
            ),
            &diameter(
                Place::Rotor,
                &[
                    word("", Says::Nothing, msg("rotor with a thread")),
                    word("B", Says::Nothing, msg("bonded rotor")),
                ],
                msg("size of the rotor, and how it is fixed"),
            ),
            &diameter(
                Place::Stator,
                &[
                    word("", Says::Nothing, msg("mounted from the front")),
                    word(
                        "H",
                        Says::Nothing,
                        msg("mounted from the front or the back"),
                    ),
                ],
                msg("outer diameter of the stator, and how it is mounted"),
            ),
            &OUTPUT,
            &RESOLUTION,
            &INTERFACE,
            &SUPPLY,
            &TEMPERATURE,
            &OPTION,
        ],
    },
    Form {
        title: "IP-75",
        source: said("IP-75, 5.3 and 5.4; its manual has no order code"),
        example: shown(&["IP-75", "ASI1"]),
        parts: &[
            &Part::of(
                Place::Series,
                &[word(
                    "IP-75",
                    Says::Series(Series::Ip75),
                    msg("inductosyn ИП-75"),
                )],
                msg("series"),
            ),
            &Part::of(
                Place::Interface,
                &[
                    word(
                        "ASI1",
                        Says::Interface(Interface::Asi1),
                        msg("binary stream over RS-485"),
                    ),
                    word(
                        "ASI4",
                        Says::Interface(Interface::Asi4),
                        msg("text stream over RS-485"),
                    ),
                    word(
                        "SSI7",
                        Says::Interface(Interface::Ssi7),
                        msg("SSI of 30 bits"),
                    ),
                ],
                msg("what it sends"),
            ),
        ],
    },
    Form {
        title: "Pepperl+Fuchs",
        source: said("P+F article, table 6"),
        example: shown(&["AVM58", ""]),
        parts: &[
            &Part::of(
                Place::Series,
                &[
                    word(
                        "AVS58",
                        Says::Series(Series::Avs58),
                        msg("single turn, solid shaft"),
                    ),
                    word(
                        "AVM58",
                        Says::Series(Series::Avm58),
                        msg("multi-turn, solid shaft"),
                    ),
                    word(
                        "ASS58",
                        Says::Series(Series::Ass58),
                        msg("single turn, hollow shaft"),
                    ),
                    word(
                        "ASM58",
                        Says::Series(Series::Asm58),
                        msg("multi-turn, hollow shaft"),
                    ),
                ],
                msg("series"),
            ),
            &Part::of(
                Place::Logic,
                &[
                    word("", Says::Nothing, msg("a microcontroller, with a preset")),
                    word(
                        "H",
                        Says::HardWired,
                        msg("hard-wired logic, without preset"),
                    ),
                ],
                msg("nothing, or H for hard-wired logic"),
            )
            .or(""),
        ],
    },
    Form {
        title: msg("MPP or PT"),
        source: said("MPP and PT, T485 note 2, BUS version table, CRC-6 program"),
        example: shown(&["17M", "T"]),
        parts: &[
            &RESOLUTION,
            // The CRC-6 program calls BiSS-C models 17M and 16.
            &INTERFACE.or("B"),
        ],
    },
];
