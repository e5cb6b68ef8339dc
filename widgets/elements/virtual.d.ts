declare module 'virtual:fastslam-files' {
  export const program: string
  export const worker: string
}
