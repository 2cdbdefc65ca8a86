// The few words of the element itself. Names and docs of fields come from the core.
const WORDS = {
  en: {
    bit: 'bit',
    bits: 'Bits of the frame, in order of transmission',
    fields: 'Fields of the frame',
    follow: 'checks follow',
    good: 'good frame',
    turns: 'turns',
    invalid: 'the encoder says that the position is not valid',
    warns: 'the encoder warns',
    refused: 'refused by a receiver',
  },
  ru: {
    bit: 'бит',
    bits: 'Биты кадра в порядке передачи',
    fields: 'Поля кадра',
    follow: 'контрольные поля пересчитываются',
    good: 'кадр верен',
    turns: 'обороты',
    invalid: 'датчик сообщает, что положение недействительно',
    warns: 'датчик предупреждает',
    refused: 'приёмник отвергает кадр',
  },
};

/** The words of a language such as `ru` or `ru-RU`; English where there are none. */
export const words = (lang) => WORDS[lang?.split('-')[0].toLowerCase()] ?? WORDS.en;
