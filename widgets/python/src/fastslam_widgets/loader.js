// What the model of each figure carries. The figures' own script is in one model that all of them share: a saved notebook keeps what each
// model carries, and would have that script once for every figure.
const modules = (globalThis.fastslamModules ??= new Map())

/** The module of the figures, made once of a script. */
function moduleOf(script) {
  if (!modules.has(script)) modules.set(script, import(URL.createObjectURL(new Blob([script], { type: 'text/javascript' }))))
  return modules.get(script)
}

async function render(context) {
  const { model } = context
  const library = await model.widget_manager.get_model(model.get('library').replace('IPY_MODEL_', ''))
  const { default: figures } = await moduleOf(library.get('script'))
  return figures.render(context)
}

export default { render }
