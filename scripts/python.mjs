// The Python package of the figures: its files, and the virtual environments that build and try it.
import { existsSync, mkdirSync, readFileSync } from 'node:fs'
import { join } from 'node:path'
import { dist } from './build.mjs'
import { describe, figures, options, round, write } from './elements.mjs'
import { cache, readIfThere, root, run, StepError, which } from './lib.mjs'

const folder = join(root, 'widgets', 'python', 'src', 'fastslam_widgets')

/**
 * A Python with these packages: an environment of that name, made at its first use. Says so where there is no Python or no PyPI.
 * @param {string} name @param {string[]} wanted
 */
export async function python(name, ...wanted) {
  const base = which('python3')
  const hint = 'On Debian or Ubuntu: apt-get install python3-venv; pip must reach PyPI or a mirror of it.'
  if (!base) throw new StepError('There is no python3 on PATH.', hint)
  const home = cache('python', name)
  const interpreter = join(home, 'bin', 'python')
  const stamp = join(home, 'installed-for')
  if (readIfThere(stamp) !== wanted.join(' ')) {
    mkdirSync(home, { recursive: true })
    if (!existsSync(interpreter)) await run(base, ['-m', 'venv', home], { hint })
    await run(interpreter, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', ...wanted], { hint })
    write(stamp, wanted.join(' '))
  }
  return interpreter
}

/** A trait of traitlets for a parameter. @param {import('./elements.mjs').ParamSpec} spec */
function trait({ name, kind, min, max, choices, default: value, help }) {
  const words = choices.map(choice => JSON.stringify(choice.value)).join(', ')
  const bounds = `min=${round(min)}, max=${round(max)}`
  const text = JSON.stringify(help)
  if (kind === 'flag' || kind === 'toggle') return `traitlets.Bool(${value === 'on' ? 'True' : 'False'}, help=${text})`
  if (kind === 'text') return `traitlets.Unicode(${JSON.stringify(value)}, help=${text})`
  if (kind === 'choice') return `traitlets.Enum([${words}], ${JSON.stringify(value)}, help=${text})`
  if (words) return `traitlets.Union([traitlets.${kind === 'integer' ? 'Int' : 'Float'}(), traitlets.Enum([${words}])], default_value=${JSON.stringify(value)}, help=${text})`
  // How many steps and rows there are depends on the setup: the figure knows.
  if (name === 'step' || name === 'row' || name === 'column' || name === 'universe') return `traitlets.Int(${value}, min=${Math.min(min, 0)}, help=${text})`
  return `traitlets.${kind === 'integer' ? 'Int' : 'Float'}(${value}, ${bounds}, help=${text})`
}

/** Writes what is generated of the package: its classes, and the module that runs in the page. */
export async function pythonFiles() {
  const all = figures()
  const snake = (/** @type {string} */ name) => name.replaceAll('-', '_')
  const classes = all.map(
    ({ className, name, title, params }) =>
      `class ${className}(Figure):\n    """${title}.\n\n${params.map(spec => `    ${snake(spec.name)}: ${describe(spec)}`).join('\n')}\n    """\n\n` +
      `    figure = traitlets.Unicode("${name}", read_only=True).tag(sync=True)\n` +
      `    _parameters = (${params.map(spec => `"${snake(spec.name)}"`).join(', ')},)\n` +
      params.map(spec => `    ${snake(spec.name)} = ${trait(spec)}.tag(sync=True)`).join('\n'),
  )
  const python = `"""The figures. Made by scripts/python.mjs from what they tell of themselves."""\n\nimport traitlets\n\nfrom ._base import Figure\n\n\n${classes.join('\n\n\n')}\n`
  write(join(folder, '_figures.py'), python)
  const names = all.map(({ className }) => className)
  write(
    join(folder, '__init__.py'),
    `"""Live figures on FastSLAM and Rao-Blackwellized particle filters, in notebooks.\n\n    from fastslam_widgets import FastslamLap\n\n    lap = FastslamLap(v=13, universes=16, seed=3)\n    lap\n"""\n\nfrom ._figures import ${names.join(', ')}\n\n__all__ = [${names.map(name => `"${name}"`).join(', ')}]\n`,
  )
  const optionTraits = options.map(({ name, values }) => `    ${name} = ${name === 'v' ? 'traitlets.Union([traitlets.Int(min=1), traitlets.Enum(["latest"])], allow_none=True, default_value=None)' : values ? `traitlets.Enum([${values.map(v => `"${v}"`).join(', ')}], None, allow_none=True)` : 'traitlets.Unicode(None, allow_none=True)'}.tag(sync=True)`)
  write(join(folder, '_options.py'), `"""Attributes of every figure. Made by scripts/python.mjs."""\n\nimport traitlets\n\n\nclass Options(traitlets.HasTraits):\n    """What an author may fix about any figure, besides its parameters."""\n\n${optionTraits.join('\n')}\n`)
  for (const file of ['fastslam-anywidget.js', 'licences.txt', 'sbom.cdx.json']) write(join(folder, 'static', file), readFileSync(join(dist, file), 'utf8'))
}
