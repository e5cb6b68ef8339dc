declare module 'virtual:fastslam-files' {
  export const example: string
  export const program: string
  /** That which reads bags, where `program` does not. */
  export const bags: string
  export const worker: string
  export const words: Record<string, import('./words').Catalogue | undefined>
}
