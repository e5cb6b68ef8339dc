// The glue that wasm-bindgen writes is a module, and a module has one instance: a program that has trapped could not be replaced, and
// a page could not have two programs. The same lines inside a function have as many as there are calls.
import { readFileSync } from 'node:fs'
import { basename, join } from 'node:path'
import { root, StepError } from './lib.mjs'

/** The glue and its types, as wasm-bindgen names them. */
export const gluePaths = ['fastslam_widgets.js', 'fastslam_widgets.d.ts', 'fastslam_widgets_bg.wasm.d.ts'].map(name => join(root, 'widgets', 'pkg', name))

/** `createShell(module)`, which makes an instance and returns what the glue exports. @param {string} glue */
export function shellModule(glue) {
  const names = [...glue.matchAll(/^export (?:class|function) (\w+)/gm)].map(([, name]) => name)
  // How it fetches a program is left out: ours has been compiled when it comes here.
  const [body = '', loader] = glue.split(/^async function __wbg_load\(/m)
  const inner = body.replace(/^export (?=class |function )/gm, '')
  const known = /^export \{ initSync, __wbg_init as default \};$/m.test(loader ?? '') && inner.includes('function __wbg_finalize_init(instance, module)')
  if (names.length === 0 || !known || /^(export|import) /m.test(inner) || inner.includes('import.meta')) {
    throw new StepError('widgets/pkg/fastslam_widgets.js is not what scripts/glue.mjs knows of wasm-bindgen: has its version changed?')
  }
  return `// Made by scripts/glue.mjs from widgets/pkg/fastslam_widgets.js.
export async function createShell(module) {
${inner}
__wbg_finalize_init(await WebAssembly.instantiate(module, __wbg_get_imports()), module)
return { memory: wasm.memory, ${names.join(', ')} }
}
`
}

export const shellTypes = `// Made by scripts/glue.mjs.
export type Shell = Omit<typeof import('../../pkg/fastslam_widgets.js'), 'default' | 'initSync'> & { memory: WebAssembly.Memory }
export function createShell(module: WebAssembly.Module): Promise<Shell>
`

export const readGlue = () => readFileSync(join(root, 'widgets', 'pkg', 'fastslam_widgets.js'), 'utf8')

/** Holds a program to the glue, which was written for another one. @param {string} program its file */
export function checkGlue(program) {
  const glue = readGlue()
  const missing = WebAssembly.Module.imports(new WebAssembly.Module(readFileSync(program))).filter(({ name }) => !glue.includes(name))
  if (missing.length > 0) throw new StepError(`The glue has not got what ${basename(program)} imports: ${missing.map(({ name }) => name).join(', ')}.`)
}
