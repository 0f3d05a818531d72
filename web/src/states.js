// States of contact points: of each (CSTATUS), and how many there are in an increment.
import { css } from './theme.js';

export const stateWords = ['open', 'stick', 'slip', 'closed'];
const colours = { slipping: '--slip' };

export const stateColour = (word) => css(colours[word] ?? `--${word}`);

/** Counts that say something of these increments: without friction no point sticks or slides. */
export function countedStates(increments) {
  const some = (key) => increments.some((i) => i[key]);
  return ['open', ...(some('stick') || some('slipping') ? ['stick', 'slipping'] : []),
    ...(some('closed') ? ['closed'] : [])];
}
