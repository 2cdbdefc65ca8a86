// Measured figures in a document: between `<!-- name -->` and `<!-- end of name -->`.
import { readFile, writeFile } from 'node:fs/promises';

export const put = async (path, name, lines) => {
  const [start, end] = [`<!-- ${name} -->`, `<!-- end of ${name} -->`];
  const text = await readFile(path, 'utf8');
  const [before, rest] = text.split(start);
  const after = rest.split(end)[1];
  await writeFile(path, `${before}${start}\n\n${lines.join('\n')}\n\n${end}${after}`);
};
