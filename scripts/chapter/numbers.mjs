// Measured numbers: from www/data/numbers.json by key, never typed. Which keys are used is remembered, because one that no page uses is a mistake.

/** @typedef {{ value: number, unit: string, made: string }} Quantity a number as it is kept, with its unit ("" for a plain one) and what made it */

const nonBreaking = '\u00a0'
const thin = '\u202f'

/** A number as the chapter sets it: a true minus, thin spaces between thousands from 10 000 on. @param {number} value @param {number} digits @param {import('./translation.mjs').Language} [language] */
export function typeset(value, digits, language = 'en') {
  const [whole = '', fraction] = Math.abs(value).toFixed(digits).split('.')
  const grouped = whole.length > 4 ? whole.replace(/\B(?=(\d{3})+$)/g, thin) : whole
  return `${value < 0 && Number(value.toFixed(digits)) !== 0 ? '−' : ''}${grouped}${fraction ? `${language === 'de' ? ',' : '.'}${fraction}` : ''}`
}

/** Places after the point where the text asks for none: two or three figures that count, and none for a whole number. @param {number} value */
function places(value) {
  const size = Math.abs(value)
  if (Number.isInteger(value)) return 0
  if (size >= 1) return size < 10 ? 2 : size < 100 ? 1 : 0
  return size >= 0.1 ? 2 : Math.min(8, 1 - Math.floor(Math.log10(size)))
}

export class Numbers {
  /** @type {Set<string>} */
  #used = new Set()

  /** @param {Record<string, Quantity>} all */
  constructor(all) {
    /** The numbers, for whoever renders many of them: what is read counts as used. */
    this.all = new Proxy(all, {
      get: (target, key) => {
        if (typeof key === 'string' && key in target) this.#used.add(key)
        return Reflect.get(target, key)
      },
    })
  }

  /**
   * @param {string} key @param {{ digits?: number | undefined, unit?: boolean, percent?: boolean, language?: import('./translation.mjs').Language }} [options]
   * @returns {string | undefined} undefined where there is no such number
   */
  text(key, { digits, unit = true, percent = false, language = 'en' } = {}) {
    if (!Object.keys(this.all).includes(key)) return undefined
    const number = /** @type {Quantity} */ (this.all[key])
    if (percent) return `${typeset(100 * number.value, digits ?? (Math.abs(number.value) < 0.095 ? 1 : 0), language)}${unit ? `${nonBreaking}%` : ''}`
    const text = typeset(number.value, digits ?? places(number.value), language)
    return unit && number.unit !== '1' && number.unit !== '' ? `${text}${nonBreaking}${number.unit}` : text
  }

  unused() {
    return Object.keys(this.all).filter(key => !this.#used.has(key))
  }
}
